#include "render/airway_layer.h"

#include <algorithm>
#include <utility>

#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

#include "render/breath_shader.h"
#include "render/convert.h"

namespace pneuma {
namespace {

// While things move, this many of the widest airways are tubes, and this many more are lines.
constexpr std::size_t MovingTubes = 1500;
constexpr std::size_t MovingLines = 20'000;
constexpr int MovingSides = 6;
constexpr Rgb Highlight = rgbOfHex(0xff5a1f);

/// Shows a mesh that may breathe.
template <class Mesh>
void showMesh(vtkActor* actor, const Mesh& mesh, const AirwayTree* tree,
              const BreathingScene* breathing, const BreathScale& scale) {
  vtkNew<vtkPolyDataMapper> mapper;
  const vtkSmartPointer<vtkPolyData> data = polyDataOf(mesh);
  mapper->SetInputData(data);
  mapper->SetScalarModeToUsePointData();
  mapper->StaticOn();
  actor->SetMapper(mapper);
  actor->GetShaderProperty()->ClearAllVertexShaderReplacements();
  if (breathing == nullptr || tree == nullptr) return;
  letBreathe(actor, data, breathAttributes(*tree, breathing->tree, mesh.points, mesh.branches));
  setBreath(actor, scale);
}

void makeShiny(vtkActor* actor) {
  vtkProperty* property = actor->GetProperty();
  property->SetAmbient(0.10);
  property->SetDiffuse(0.92);
  property->SetSpecular(0.22);
  property->SetSpecularPower(24.0);
  property->SetInterpolationToPhong();
}

void addLobes(const AirwayTree& tree, const std::vector<bool>& visible, std::set<Lobe>& lobes) {
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (visible[i]) lobes.insert(tree[i].lobe);
  }
}

/// The visible branches, the widest first: mothers stand before daughters of the same width.
std::vector<std::uint32_t> widestFirst(const AirwayTree& tree, const std::vector<bool>& visible) {
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (visible[i]) order.push_back(static_cast<std::uint32_t>(i));
  }
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::uint32_t i) { return tree[i].radiusMm; });
  return order;
}

/// True if tubes or their colours would come out differently.
bool differInTubes(const SceneOptions& a, const SceneOptions& b) {
  return a.colourBy != b.colourBy || a.palette != b.palette || a.background != b.background ||
         a.maxGeneration != b.maxGeneration || a.radiusScale != b.radiusScale;
}

}  // namespace

AirwayLayer::AirwayLayer(vtkRenderer* renderer) {
  for (vtkActor* actor : actors()) {
    makeShiny(actor);
    actor->VisibilityOff();
    actor->PickableOff();
    renderer->AddActor(actor);
  }
  coarseLines_->GetProperty()->LightingOff();
  coarseLines_->GetProperty()->SetLineWidth(1.5F);
  selection_->GetProperty()->SetAmbient(0.45);
}

std::array<vtkActor*, 5> AirwayLayer::actors() const {
  return {tubes_.Get(), coarseTubes_.Get(), coarseLines_.Get(), givenTubes_.Get(),
          selection_.Get()};
}

void AirwayLayer::show(vtkActor* actor, const TubeMesh& mesh) {
  showMesh(actor, mesh, tree_.get(), breathing_.get(), scale_);
}

void AirwayLayer::show(vtkActor* actor, const LineMesh& mesh) {
  showMesh(actor, mesh, tree_.get(), breathing_.get(), scale_);
}

void AirwayLayer::setBreathing(std::shared_ptr<const BreathingScene> breathing) {
  if (breathing && tree_ && breathing->tree.ends.size() != tree_->size()) breathing.reset();
  if (breathing == breathing_) return;
  breathing_ = std::move(breathing);
  scale_ = {};
  rebuild();
}

void AirwayLayer::setBreath(const BreathScale& scale) {
  if (!breathing_ || scale == scale_) return;
  scale_ = scale;
  for (vtkActor* actor :
       {tubes_.Get(), coarseTubes_.Get(), coarseLines_.Get(), givenTubes_.Get()}) {
    if (actor->GetMapper() != nullptr) pneuma::setBreath(actor, scale_);
  }
  if (selected_) buildSelection();
}

Branch AirwayLayer::movedBranchOf(std::size_t n) const {
  const Branch& branch = (*tree_)[n];
  if (!breathing_) return branch;
  return movedBranch(branch, breathing_->tree, n, scale_.of(side(branch.lobe)));
}

std::shared_ptr<const AirwayTree> AirwayLayer::movedTree() const {
  if (!tree_ || !breathing_ || scale_ == BreathScale{}) return tree_;
  auto moved = std::make_shared<AirwayTree>();
  moved->reserve(tree_->size());
  for (std::size_t n = 0; n < tree_->size(); ++n) {
    moved->add(movedBranchOf(n));
  }
  return moved;
}

void AirwayLayer::setTree(std::shared_ptr<const AirwayTree> tree, const SceneOptions& options) {
  breathing_.reset();
  tree_ = std::move(tree);
  if (tree_ != nullptr && tree_->empty()) tree_.reset();
  options_ = options;
  selected_.reset();
  rebuild();
}

void AirwayLayer::setPeers(std::vector<std::shared_ptr<const AirwayTree>> peers) {
  peers_ = std::move(peers);
  rebuild();
}

void AirwayLayer::setOptions(const SceneOptions& options) {
  const SceneOptions before = std::exchange(options_, options);
  if (differInTubes(before, options_)) rebuild();
}

void AirwayLayer::setInteractive(bool interactive) {
  interactive_ = interactive;
  // Each when it is shown first: breathing lungs need no fine tubes until they stand.
  if (interactive && !coarseBuilt_) buildCoarse();
  if (!interactive && !fineBuilt_) buildFine();
  showActors();
}

void AirwayLayer::setPreviewing(bool previewing) {
  if (previewing == previewing_) return;
  previewing_ = previewing;
  if (previewing) buildGiven();
  showActors();
}

void AirwayLayer::select(std::optional<std::size_t> branch) {
  selected_ = branch;
  if (tree_ == nullptr || (branch.has_value() && *branch >= tree_->size())) selected_.reset();
  buildSelection();
}

void AirwayLayer::rebuild() {
  fineBuilt_ = coarseBuilt_ = false;
  colours_ = {};
  visible_.clear();
  lobes_.clear();
  if (tree_ != nullptr) {
    visible_ = branchesUpTo(*tree_, options_.maxGeneration);
    addLobes(*tree_, visible_, lobes_);
    for (const auto& peer : peers_) {
      addLobes(*peer, branchesUpTo(*peer, options_.maxGeneration), lobes_);
    }
    colours_ = branchColours(*tree_, visible_, options_, peers_);
  }
  if (previewing_) buildGiven();
  setInteractive(interactive_);
  buildSelection();
}

void AirwayLayer::buildFine() {
  fineBuilt_ = true;
  if (tree_ == nullptr) return;
  show(tubes_, tubeMesh(*tree_, visible_, colours_.colours, {.radiusScale = options_.radiusScale}));
}

void AirwayLayer::buildCoarse() {
  coarseBuilt_ = true;
  if (tree_ == nullptr) return;
  const std::vector<std::uint32_t> order = widestFirst(*tree_, visible_);
  std::vector<bool> wide(tree_->size(), false);
  std::vector<bool> thin(tree_->size(), false);
  for (std::size_t i = 0; i < std::min(order.size(), MovingTubes + MovingLines); ++i) {
    (i < MovingTubes ? wide : thin)[order[i]] = true;
  }
  show(coarseTubes_, tubeMesh(*tree_, wide, colours_.colours,
                              {.radiusScale = options_.radiusScale, .sides = MovingSides}));
  show(coarseLines_, lineMesh(*tree_, thin, colours_.colours));
}

void AirwayLayer::buildGiven() {
  given_ = visible_;
  if (tree_ == nullptr) return;
  for (std::size_t i = 0; i < tree_->size(); ++i) {
    given_[i] = given_[i] && (*tree_)[i].origin != Origin::Grown;
  }
  show(givenTubes_,
       tubeMesh(*tree_, given_, colours_.colours, {.radiusScale = options_.radiusScale}));
}

void AirwayLayer::buildSelection() {
  showActors();
  if (!selected_.has_value()) return;
  // The branch alone, thicker than it is so that it stands out and covers its own tube.
  Branch branch = movedBranchOf(*selected_);
  branch.parent = -1;
  const double scale = std::max(1.15, 1.0 + 0.35 / std::max(branch.radiusMm, 0.05));
  AirwayTree alone;
  alone.add(std::move(branch));
  showMesh(selection_,
           tubeMesh(alone, {true}, {Highlight}, {.radiusScale = scale * options_.radiusScale}),
           nullptr, nullptr, {});
}

void AirwayLayer::showActors() {
  const bool whole = tree_ != nullptr && !previewing_;
  tubes_->SetVisibility(whole && !interactive_);
  coarseTubes_->SetVisibility(whole && interactive_);
  coarseLines_->SetVisibility(whole && interactive_);
  givenTubes_->SetVisibility(tree_ != nullptr && previewing_);
  selection_->SetVisibility(selected_.has_value() && (whole || given_[*selected_]));
}

}  // namespace pneuma
