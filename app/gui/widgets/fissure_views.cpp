#include "widgets/fissure_views.h"

#include <algorithm>
#include <utility>

#include "widgets/ct_views.h"
#include "widgets/scene_view.h"
#include "widgets/slice_view.h"

namespace pneuma {

namespace {

constexpr double PatchSpacingMm = 6.0;

/// True if nobody set it, and the CT does not tell it either: snapped ones have knots.
bool proposed(const UsedFissure& used) {
  return used.source == FissureSource::Proposal && used.surface.knots.empty();
}

}  // namespace

FissureViews::FissureViews(FissureEditor& editor, SliceViews& slices, CtViews& ctViews,
                           SceneView& scene, QObject* parent)
    : QObject(parent), editor_(editor), slices_(slices), ctViews_(ctViews), scene_(scene) {
  connect(&editor_, &FissureEditor::changed, this, &FissureViews::follow);
  connect(&scene_, &SceneView::lungClicked, &editor_, &FissureEditor::addPoint);
  connect(&scene_, &SceneView::markDragged, this, [this](std::size_t mark, const Vec3& to) {
    const std::vector<FissureEditor::Mark> marks = editor_.marks();
    if (mark < marks.size()) editor_.drag(marks[mark], to);
  });
  connect(&scene_, &SceneView::markReleased, &editor_, &FissureEditor::release);
}

void FissureViews::setActive(bool active) {
  if (active == active_) return;
  active_ = active;
  for (const SlicePlane plane : SlicePlanes) {
    ctViews_.slice(plane).setEditor(active ? &editor_ : nullptr);
  }
  if (!active) editor_.setPlacing(false);
  follow();
}

void FissureViews::setVisible(std::set<Side> sides) {
  if (sides == visible_) return;
  visible_ = std::move(sides);
  follow();
}

void FissureViews::follow() {
  showInScene();
  showInSlices();
}

void FissureViews::showInScene() {
  FissureScene scene;
  for (const LobePreview& lung : editor_.previews()) {
    if (!active_) break;
    const bool visible = visible_.contains(lung.side());
    FissureScene::Lung shown{lung.side(), lung.lung().mesh, nullptr, nullptr, visible};
    for (const Fissure fissure : fissuresOf(lung.side())) {
      (fissure == Fissure::RightHorizontal ? shown.horizontal : shown.oblique) =
          lung.heights(fissure);
      const Drawn& parts = drawn(lung, fissure);
      scene.sheets.push_back({parts.patch, parts.rim, proposed(editor_.used(fissure)),
                              fissure == editor_.current(), visible, parts.shows});
    }
    scene.lungs.push_back(std::move(shown));
  }
  if (active_) scene.marks = marks();
  scene_.setFissures(scene);
  scene_.setPlacing(active_ && editor_.placing() && slices_.empty());
}

const FissureViews::Drawn& FissureViews::drawn(const LobePreview& lung, Fissure fissure) {
  Drawn& parts = drawn_[fissure];
  const auto oblique = lung.heights(fissuresOf(lung.side()).front());
  const TracedFissure* traced = editor_.traced(fissure);
  const auto patch = traced != nullptr && traced->complete ? traced->patch : nullptr;
  const bool same = parts.own == lung.heights(fissure) && parts.oblique == oblique;
  if (same && parts.traced == patch) return parts;
  parts.own = lung.heights(fissure);
  parts.oblique = oblique;
  parts.traced = patch;
  parts.shows = nullptr;
  if (patch) {
    parts.patch = patch;
    parts.shows = std::make_shared<const std::vector<std::uint8_t>>(traced->complete->onSheet);
  } else {
    parts.patch = std::make_shared<const TriangleMesh>(lung.patch(fissure, PatchSpacingMm));
  }
  parts.rim = std::make_shared<const std::vector<SurfaceLine>>(lung.contour(fissure));
  return parts;
}

std::vector<FissureMark> FissureViews::marks() const {
  std::vector<FissureMark> marks;
  for (const FissureEditor::Mark& mark : editor_.marks()) {
    const bool handle = editor_.edit(mark.fissure).method == FissureMethod::Plane;
    const std::vector<std::size_t> standOut = suspects(editor_.used(mark.fissure));
    marks.push_back({mark.place, mark.fissure == editor_.current(), handle,
                     !handle && std::ranges::find(standOut, mark.index) != standOut.end()});
  }
  return marks;
}

void FissureViews::showInSlices() {
  // Lobes that are there stay to be seen in the other steps.
  if (!editor_.available() || (!active_ && !editor_.exact())) {
    slices_.setFissures(nullptr);
    return;
  }
  auto shown = std::make_shared<SliceFissures>();
  shown->reachMm = FissureEditor::SliceReachMm;
  for (const LobePreview& lung : editor_.previews()) {
    for (const Fissure fissure : fissuresOf(lung.side())) {
      SliceFissures::Line line{
          fissure,
          [surface = lung.surface(fissure)](const Vec3& p) { return surface.height(p); },
          proposed(editor_.used(fissure)),
          active_ && fissure == editor_.current(),
          {}};
      if (const auto parts = editor_.shownParts(fissure)) {
        line.shows = [parts](const Vec3& p) { return parts->shows(p); };
      }
      shown->lines.push_back(std::move(line));
    }
  }
  if (active_) shown->marks = marks();
  slices_.setFissures(std::move(shown));
}

}  // namespace pneuma
