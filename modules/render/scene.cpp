#include "render/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "core/units.h"
#include "render/airway_layer.h"
#include "render/annotations.h"
#include "render/ball_layer.h"
#include "render/branch_picker.h"
#include "render/camera.h"
#include "render/fissure_layer.h"
#include "render/lighting.h"
#include "render/preview_layer.h"
#include "render/shell_layer.h"
#include "render/surface_layer.h"
#include "render/vtk_globals.h"

namespace pneuma {
namespace {

constexpr double PickTolerancePixels = 4.0;
constexpr double MarkTolerancePixels = 9.0;
constexpr double LogicalDpi = 72.0;

/// The size of what a scene fills of its window, in logical pixels.
struct LogicalSize {
  int width = 640;
  int height = 480;
  double pixelRatio = 1.0;
};

/// The same in pixels. @pre the renderer is in a window
std::array<int, 2> pixelsOf(vtkRenderer* renderer) {
  const int* size = renderer->GetRenderWindow()->GetSize();
  const double* part = renderer->GetViewport();
  return {static_cast<int>(size[0] * (part[2] - part[0])), size[1]};
}

LogicalSize sizeOf(vtkRenderer* renderer) {
  vtkRenderWindow* window = renderer->GetRenderWindow();
  if (window == nullptr) return {};
  const std::array<int, 2> size = pixelsOf(renderer);
  const double ratio = window->GetDPI() / LogicalDpi;
  if (size[0] <= 0 || size[1] <= 0) return {};
  return {static_cast<int>(size[0] / ratio), static_cast<int>(size[1] / ratio), ratio};
}

/// Adds points between which the visible branches lie.
void addPoints(const AirwayTree& tree, const std::vector<bool>& visible, double radiusScale,
               std::vector<Vec3>& points) {
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!visible[i]) continue;
    const Branch& branch = tree[i];
    const Vec3 radius = Vec3::Constant(branch.radiusMm * radiusScale);
    for (const Vec3& end : {branch.proximal, branch.distal}) {
      points.push_back(end - radius);
      points.push_back(end + radius);
    }
    for (const CentrelinePoint& point : branch.via) points.push_back(point.position);
  }
}

Vec3 position(vtkCamera* camera) { return Vec3(camera->GetPosition()); }

Vec3 towardsEye(vtkCamera* camera) { return -Vec3(camera->GetDirectionOfProjection()); }

}  // namespace

struct Scene::State {
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderer> overlayRenderer;
  SurfaceLayer surfaces{renderer};
  AirwayLayer airways{renderer};
  PreviewLayer preview{renderer};
  FissureLayer fissures{renderer};
  ShellLayer shells{renderer};
  BallLayer balls{renderer};
  Annotations annotations{overlayRenderer};
  SceneOptions options;
  vtkSmartPointer<vtkRenderPass> passes;

  // What look() framed, kept so that the picture can be framed again when its size changes, until
  // somebody moves the camera.
  ViewDirection direction;
  std::vector<Vec3> framedPoints;
  Vec3 framedEye = Vec3::Zero();
  LogicalSize framedSize = {0, 0, 0.0};

  bool colouredByLobe() const {
    return options.colourBy == ColourBy::Lobe || airways.tree() == nullptr;
  }

  void recolour() {
    airways.setOptions(options);
    surfaces.setOptions(options, !colouredByLobe());
    preview.setOptions(options);
    fissures.setOptions(options);
    shells.setBackground(options.background);
    setBackground(renderer, options.background);
  }

  Legend legend() const {
    if (!options.legend) return {};
    if (Legend values = surfaces.legend(options.background); !values.empty()) {
      return withShells(std::move(values));
    }
    if (!colouredByLobe()) return withShells(airways.legend());
    std::set<Lobe> lobes;
    for (const FissureScene::Lung& lung : fissures.scene().lungs) {
      if (!lung.visible) continue;
      for (const Lobe lobe : FiveLobes) {
        if (side(lobe) == lung.side) lobes.insert(lobe);
      }
    }
    if (fissures.empty()) addLobes(lobes);
    lobes.insert(airways.lobes().begin(), airways.lobes().end());
    return withShells(lobeLegend(lobes, options.palette, options.background));
  }

  /// Chips for the shells too, where there is no ramp beside which they would not stand.
  Legend withShells(Legend legend) const {
    using Of = BreathingScene::Shell::Of;
    if (!legend.ramp.empty()) return legend;
    for (const Of of : {Of::ChestWall, Of::Expiration, Of::Inspiration}) {
      if (!shells.shows(of)) continue;
      const ShellLook& look = lookOf(of);
      const bool dark = options.background == Background::Dark;
      legend.chips.push_back({look.name, look.brief, dark ? look.onDark : look.onLight});
    }
    return legend;
  }

  void addLobes(std::set<Lobe>& lobes) const {
    for (const SceneSurface& surface : surfaces.surfaces()) {
      if (surface.visible) lobes.insert(surface.lobe);
    }
  }

  std::vector<Vec3> pointsToFrame() const {
    std::vector<Vec3> points;
    for (const SceneSurface& surface : surfaces.surfaces()) {
      if (!surface.visible) continue;
      points.insert(points.end(), surface.mesh->points.begin(), surface.mesh->points.end());
    }
    // Breathing lungs do not leave the picture.
    const BreathingScene* breathing = surfaces.breathing();
    for (std::size_t i = 0; breathing != nullptr && i < surfaces.surfaces().size(); ++i) {
      const SceneSurface& surface = surfaces.surfaces()[i];
      if (!surface.visible) continue;
      for (std::size_t n = 0; n < surface.mesh->points.size(); ++n) {
        points.push_back(surface.mesh->points[n] + breathing->surfaces[i].displacement[n]);
      }
    }
    shells.addPoints(points);
    if (airways.tree() != nullptr) {
      addPoints(*airways.tree(), airways.visible(), options.radiusScale, points);
    }
    for (const auto& peer : airways.peers()) {
      addPoints(*peer, branchesUpTo(*peer, options.maxGeneration), options.radiusScale, points);
    }
    if (preview.points() > 0) {
      for (int corner = 0; corner < 8; ++corner) {
        points.push_back(preview.box().corner(static_cast<Box3::CornerType>(corner)));
      }
    }
    return points;
  }

  /// @pre the renderer is in a window
  Projection projection() const {
    const std::array<int, 2> size = pixelsOf(renderer);
    vtkMatrix4x4* matrix = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
        static_cast<double>(size[0]) / size[1], -1.0, 1.0);
    Projection projection;
    std::copy_n(matrix->GetData(), projection.clipFromWorld.size(),
                projection.clipFromWorld.begin());
    projection.width = size[0];
    projection.height = size[1];
    return projection;
  }

  double windowPixels(double logical) const {
    return logical * renderer->GetRenderWindow()->GetDPI() / LogicalDpi;
  }

  Vec3 worldPoint(double x, double y, double depth) const {
    renderer->SetDisplayPoint(x, y, depth);
    renderer->DisplayToWorld();
    const double* world = renderer->GetWorldPoint();
    return Vec3(world[0], world[1], world[2]) / world[3];
  }

  void frame(const LogicalSize& size) {
    const CameraPose pose =
        framed(framedPoints, direction, size.width, size.height, annotations.insets());
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOff();
    camera->SetViewAngle(ViewAngleDeg);
    camera->SetPosition(pose.eye.data());
    camera->SetFocalPoint(pose.focus.data());
    camera->SetViewUp(pose.up.data());
    framedEye = position(camera);
    framedSize = size;
  }

  bool cameraUntouched() const {
    return (position(renderer->GetActiveCamera()) - framedEye).norm() < 1e-9;
  }
};

Scene::Scene() : state_(std::make_unique<State>()) {
  prepareVtk();
  vtkRenderer* renderer = state_->renderer;
  addLights(renderer);
  state_->passes = addPasses(renderer);
  renderer->SetActiveCamera(vtkNew<vtkCamera>());
  state_->overlayRenderer->SetLayer(1);
  state_->overlayRenderer->InteractiveOff();
  state_->recolour();
  look({});
}

Scene::~Scene() {
  if (vtkRenderWindow* window = state_->renderer->GetRenderWindow(); window != nullptr) {
    window->RemoveRenderer(state_->overlayRenderer);
    window->RemoveRenderer(state_->renderer);
  }
}

void Scene::attachTo(vtkRenderWindow* window) {
  if (vtkRenderWindow* before = state_->renderer->GetRenderWindow(); before != nullptr) {
    before->RemoveRenderer(state_->overlayRenderer);
    before->RemoveRenderer(state_->renderer);
    state_->passes = addPasses(state_->renderer);  // the old ones hold shaders of the old window
  }
  if (window == nullptr) return;
  window->SetMultiSamples(0);
  window->SetNumberOfLayers(2);
  window->AddRenderer(state_->renderer);
  window->AddRenderer(state_->overlayRenderer);
}

void Scene::setColumns(double from, double to) {
  state_->renderer->SetViewport(from, 0.0, to, 1.0);
  state_->overlayRenderer->SetViewport(from, 0.0, to, 1.0);
}

void Scene::setSurfaces(std::vector<SceneSurface> surfaces) {
  state_->surfaces.setSurfaces(std::move(surfaces), state_->options);
  state_->shells.setBreathing(nullptr, state_->options.background);
  state_->balls.setBreath({});
  state_->recolour();
}

void Scene::setSurfaceVisible(std::size_t index, bool visible) {
  state_->surfaces.setVisible(index, visible);
}

void Scene::setSurfaceDensity(std::size_t index, double density) {
  state_->surfaces.setDensity(index, density);
}

void Scene::setFissures(const FissureScene& fissures) {
  state_->fissures.show(fissures, state_->options);
  state_->surfaces.setShown(state_->fissures.empty());
}

std::optional<std::size_t> Scene::markAt(double x, double y) const {
  const std::vector<FissureMark>& marks = state_->fissures.scene().marks;
  if (marks.empty() || state_->renderer->GetRenderWindow() == nullptr) return std::nullopt;
  const Projection projection = state_->projection();
  const double reach = state_->windowPixels(MarkTolerancePixels);
  std::optional<std::size_t> nearest;
  double least = 0.0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Vec3 at = projection.project(marks[i].place);
    if (at.z() <= 0.0 || std::hypot(at.x() - x, at.y() - y) > reach) continue;
    if (nearest && at.z() > least) continue;
    nearest = i;
    least = at.z();
  }
  return nearest;
}

Vec3 Scene::markPlace(std::size_t mark) const { return state_->fissures.scene().marks[mark].place; }

std::optional<Vec3> Scene::lungPointAt(double x, double y) const {
  if (state_->renderer->GetRenderWindow() == nullptr) return std::nullopt;
  const Vec3 from = state_->worldPoint(x, y, 0.0);
  const Vec3 to = state_->worldPoint(x, y, 1.0);
  const std::optional<double> share = state_->fissures.firstHit(from, to);
  if (!share) return std::nullopt;
  return from + *share * (to - from);
}

std::optional<SurfaceHit> Scene::surfaceAt(double x, double y) const {
  if (state_->renderer->GetRenderWindow() == nullptr) return std::nullopt;
  return state_->surfaces.firstHit(state_->worldPoint(x, y, 0.0), state_->worldPoint(x, y, 1.0));
}

Vec3 Scene::pointBeside(double x, double y, const Vec3& other) const {
  vtkRenderer* renderer = state_->renderer;
  renderer->SetWorldPoint(other.x(), other.y(), other.z(), 1.0);
  renderer->WorldToDisplay();
  return state_->worldPoint(x, y, renderer->GetDisplayPoint()[2]);
}

void Scene::setTree(std::shared_ptr<const AirwayTree> tree) {
  state_->airways.setTree(std::move(tree), state_->options);
  state_->recolour();
}

void Scene::setPeers(std::vector<std::shared_ptr<const AirwayTree>> peers) {
  state_->airways.setPeers(std::move(peers));
  state_->recolour();
}

void Scene::addPreview(std::span<const Vec3> points) {
  if (points.empty()) return;
  state_->preview.add(points);
  state_->airways.setPreviewing(true);
}

void Scene::clearPreview() {
  state_->preview.clear();
  state_->airways.setPreviewing(false);
}

std::size_t Scene::previewed() const { return state_->preview.points(); }

void Scene::setOptions(const SceneOptions& options) {
  if (options == state_->options) return;
  state_->options = options;
  state_->recolour();
}

const SceneOptions& Scene::options() const { return state_->options; }

void Scene::setBreathing(std::shared_ptr<const BreathingScene> breathing) {
  state_->surfaces.setBreathing(breathing, state_->options);
  const bool taken = state_->surfaces.breathing() != nullptr;
  state_->shells.setBreathing(taken ? breathing : nullptr, state_->options.background);
  state_->airways.setBreathing(std::move(breathing));
  state_->recolour();
}

void Scene::setBreath(const BreathScale& scale) {
  state_->surfaces.setBreath(scale);
  state_->airways.setBreath(scale);
  state_->shells.setBreath(scale);
  state_->balls.setBreath(scale);
}

void Scene::setOnionSkin(bool on) { state_->shells.setOnionSkin(on); }

void Scene::setBalls(std::vector<SceneBall> balls) { state_->balls.setBalls(std::move(balls)); }

void Scene::setInteractive(bool interactive) {
  state_->airways.setInteractive(interactive);
  state_->surfaces.setInteractive(interactive);
  setSmooth(state_->renderer, state_->passes, !interactive);
}

void Scene::select(std::optional<std::size_t> branch) { state_->airways.select(branch); }

void Scene::look(ViewDirection direction) {
  state_->direction = direction;
  state_->framedPoints = state_->pointsToFrame();
  const LogicalSize size = sizeOf(state_->renderer);
  state_->annotations.arrange(size.width, size.height, state_->legend(), state_->options);
  state_->frame(size);
}

void Scene::centreOn(const Vec3& point) {
  vtkCamera* camera = state_->renderer->GetActiveCamera();
  const Vec3 eye = position(camera) + point - Vec3(camera->GetFocalPoint());
  camera->SetFocalPoint(point.data());
  camera->SetPosition(eye.data());
}

ViewDirection Scene::lookingFrom() const {
  vtkCamera* camera = state_->renderer->GetActiveCamera();
  return viewDirectionOf(towardsEye(camera), Vec3(camera->GetViewUp()));
}

int Scene::legendWidth() const {
  const Insets& insets = state_->annotations.insets();
  return static_cast<int>(std::floor(insets.right - insets.left));
}

std::optional<std::size_t> Scene::branchAt(double x, double y) const {
  const std::shared_ptr<const AirwayTree> tree = state_->airways.movedTree();
  vtkRenderWindow* window = state_->renderer->GetRenderWindow();
  if (tree == nullptr || window == nullptr) return std::nullopt;
  return branchUnder(*tree, state_->airways.visible(), state_->options.radiusScale,
                     state_->projection(), x, y, state_->windowPixels(PickTolerancePixels));
}

void Scene::updateAnnotations() {
  const LogicalSize size = sizeOf(state_->renderer);
  vtkCamera* camera = state_->renderer->GetActiveCamera();
  state_->annotations.arrange(size.width, size.height, state_->legend(), state_->options);
  const bool resized =
      size.width != state_->framedSize.width || size.height != state_->framedSize.height;
  if (resized && state_->cameraUntouched()) state_->frame(size);
  state_->preview.followCamera(size.pixelRatio);
  state_->surfaces.sortBackToFront();
  camera->OrthogonalizeViewUp();
  ViewAxes axes;
  axes.towardsEye = towardsEye(camera);
  axes.up = Vec3(camera->GetViewUp());
  axes.right = axes.up.cross(axes.towardsEye);
  const double mmInHeight =
      2.0 * camera->GetDistance() * std::tan(radians(0.5 * camera->GetViewAngle()));
  state_->annotations.draw(axes, size.height / mmInHeight, size.pixelRatio);
  // What the graphics card moves, VTK knows nothing of.
  double box[6];
  state_->renderer->ComputeVisiblePropBounds(box);
  const double reach = state_->surfaces.reachMm();
  for (int axis = 0; axis < 3; ++axis) {
    box[2 * axis] -= reach;
    box[2 * axis + 1] += reach;
  }
  if (box[0] <= box[1]) state_->renderer->ResetCameraClippingRange(box);
}

vtkRenderer* Scene::renderer() const { return state_->renderer; }

}  // namespace pneuma
