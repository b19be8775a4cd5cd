#include "document/fissure_editor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "core/error.h"
#include "document/text.h"
#include "lobes/fissure_fit.h"

namespace pneuma {

namespace {

constexpr double PatchSpacingMm = 8.0;  ///< of a patch that only tells where the fissure is
constexpr double ShareTolerance = 1e-3;

/// As the window lists them.
constexpr std::array<Fissure, 3> Order = {Fissure::LeftOblique, Fissure::RightOblique,
                                          Fissure::RightHorizontal};

bool valid(const LobeShares& shares) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  return std::abs(sum - 1.0) <= ShareTolerance &&
         std::ranges::all_of(shares, [](double share) { return share > 0.0; });
}

/// Only what there is of one fissure.
LobeEdits only(const LobeEdits& edits, Fissure fissure) {
  LobeEdits one;
  const auto found = edits.fissures.find(fissure);
  if (found != edits.fissures.end()) one.fissures.insert(*found);
  return one;
}

}  // namespace

FissureEditor::FissureEditor(Document& document, QObject* parent)
    : QObject(parent), document_(document) {
  connect(&document_, &Document::changed, this, &FissureEditor::follow);
  follow();
}

std::vector<Fissure> FissureEditor::fissures() const {
  std::vector<Fissure> there;
  for (const Fissure fissure : Order) {
    if (preview(side(fissure)) != nullptr) there.push_back(fissure);
  }
  return there;
}

void FissureEditor::setCurrent(Fissure fissure) {
  if (fissure == current_) return;
  current_ = fissure;
  emit changed();
}

void FissureEditor::step(int by) {
  const std::vector<Fissure> there = fissures();
  if (there.empty()) return;
  const auto count = static_cast<int>(there.size());
  const auto at = static_cast<int>(std::ranges::find(there, current_) - there.begin());
  setCurrent(there[static_cast<std::size_t>((at + by + count) % count)]);
}

void FissureEditor::setPlacing(bool placing) {
  placing = placing && available();
  if (placing == placing_) return;
  placing_ = placing;
  emit changed();
}

const FissureEdit& FissureEditor::edit(Fissure fissure) const {
  static const FissureEdit none;
  const auto found = draft_.fissures.find(fissure);
  return found == draft_.fissures.end() ? none : found->second;
}

QString FissureEditor::problem(Fissure fissure) const {
  const auto found = used_.find(fissure);
  return found == used_.end() ? QString() : found->second.problem;
}

const LobePreview* FissureEditor::preview(Side side) const {
  for (const LobePreview& preview : previews_) {
    if (preview.side() == side) return &preview;
  }
  return nullptr;
}

bool FissureEditor::exact() const {
  return document_.model().lobes && draft_ == document_.snapshot().splitEdits;
}

std::map<Lobe, double> FissureEditor::volumesMm3() const {
  if (exact()) return document_.model().lobes->lobeMm3;
  std::map<Lobe, double> volumes;
  for (const LobePreview& preview : previews_) volumes.merge(preview.volumesMm3());
  return volumes;
}

std::vector<FissureEditor::Mark> FissureEditor::marks() const {
  std::vector<Mark> marks;
  const auto add = [&](Fissure fissure) {
    const std::vector<Vec3> places = marksOf(edit(fissure));
    for (std::size_t i = 0; i < places.size(); ++i) marks.push_back({fissure, i, places[i]});
  };
  for (const Fissure fissure : fissures()) {
    if (fissure != current_) add(fissure);
  }
  add(current_);
  return marks;
}

std::optional<FissureEditor::Mark> FissureEditor::markAt(const Vec3& point, int normal,
                                                         double reachMm) const {
  std::optional<Mark> nearest;
  double least = reachMm;
  for (const Mark& mark : marks()) {
    Vec3 offset = mark.place - point;
    if (std::abs(offset[normal]) > SliceReachMm) continue;
    offset[normal] = 0.0;
    if (offset.norm() > least) continue;
    least = offset.norm();
    nearest = mark;
  }
  return nearest;
}

void FissureEditor::setMethod(Fissure fissure, FissureMethod method) {
  current_ = fissure;
  LobeEdits edits = document_.snapshot().lobeEdits;
  FissureEdit& edit = edits.fissures[fissure];
  if (edit.method == method) {
    emit changed();
    return;
  }
  edit.method = method;
  if (method == FissureMethod::Plane && !edit.handles) edit.handles = firstHandles(fissure);
  commit(edits, method == FissureMethod::Plane ? tr("take a plane") : tr("take points"));
}

void FissureEditor::addPoint(const Vec3& point) {
  if (edit(current_).method != FissureMethod::Points || !available()) return;
  LobeEdits edits = document_.snapshot().lobeEdits;
  edits.fissures[current_].points.push_back(point);
  commit(edits, tr("set a point"));
}

void FissureEditor::removePoint(Fissure fissure, std::size_t index) {
  LobeEdits edits = document_.snapshot().lobeEdits;
  FissureEdit& edit = edits.fissures[fissure];
  if (edit.method != FissureMethod::Points || index >= edit.points.size()) return;
  edit.points.erase(edit.points.begin() + static_cast<std::ptrdiff_t>(index));
  commit(edits, tr("delete a point"));
}

void FissureEditor::removeLast() {
  const std::size_t count = edit(current_).points.size();
  if (count > 0) removePoint(current_, count - 1);
}

void FissureEditor::clear() {
  LobeEdits edits = document_.snapshot().lobeEdits;
  edits.fissures.erase(current_);
  commit(edits, tr("go back to the proposal"));
}

void FissureEditor::setShares(const std::map<Side, LobeShares>& shares) {
  LobeEdits edits = document_.snapshot().lobeEdits;
  edits.shares = shares;
  commit(edits, tr("want volumes"));
}

void FissureEditor::drag(const Mark& mark, const Vec3& to) {
  LobeEdits edits = draft_;
  FissureEdit& edit = edits.fissures[mark.fissure];
  if (edit.method == FissureMethod::Plane && edit.handles && mark.index < edit.handles->size()) {
    (*edit.handles)[mark.index] = to;
  } else if (edit.method == FissureMethod::Points && mark.index < edit.points.size()) {
    edit.points[mark.index] = to;
  } else {
    return;
  }
  current_ = mark.fissure;
  dragged_ = edit.method == FissureMethod::Plane ? tr("turn a plane") : tr("move a point");
  update(edits);
}

void FissureEditor::dragSmoothness(double smoothness) {
  LobeEdits edits = draft_;
  edits.options.smoothness = smoothness;
  dragged_ = tr("change the smoothness");
  update(edits);
}

void FissureEditor::release() {
  if (dragged_.isEmpty()) return;
  const QString what = std::exchange(dragged_, QString());
  commit(draft_, what);
}

void FissureEditor::commit(const LobeEdits& edits, const QString& what) {
  dragged_.clear();
  document_.setLobeEdits(edits, what);
  // Where it was not taken, because a job runs, the document's edits are shown again.
  update(document_.snapshot().lobeEdits);
}

void FissureEditor::follow() {
  if (document_.snapshot().lungs != lungs_) begin();
  // A drag goes on while the lobes of the last one are being split.
  if (dragged_.isEmpty()) update(document_.snapshot().lobeEdits);
}

void FissureEditor::begin() {
  lungs_ = document_.snapshot().lungs;
  previews_.clear();
  used_.clear();
  dragged_.clear();
  draft_ = {};
  for (const auto& lung : lungs_) {
    std::vector<std::string> ignored;
    FissureSurfaces surfaces;
    for (const auto& [fissure, used] :
         fissureSurfaces(lung->extent, lung->side, {}, draft_.options, ignored)) {
      surfaces[fissure] = used.surface;
      used_[fissure].fissure = used;
    }
    previews_.emplace_back(lung, surfaces);
  }
  placing_ = placing_ && available();
  const std::vector<Fissure> there = fissures();
  if (!there.empty() && std::ranges::find(there, current_) == there.end()) current_ = there[0];
}

void FissureEditor::update(const LobeEdits& edits) {
  const bool all = !(edits.options == draft_.options) || edits.shares != draft_.shares;
  const LobeEdits before = std::exchange(draft_, edits);
  for (LobePreview& preview : previews_) {
    for (const Fissure fissure : fissuresOf(preview.side())) {
      if (all || !(only(before, fissure) == only(edits, fissure))) {
        workOut(fissure, preview, edits);
      }
    }
    moveToShares(preview, edits);
  }
  emit changed();
}

void FissureEditor::workOut(Fissure fissure, LobePreview& preview, const LobeEdits& edits) {
  Used& used = used_[fissure];
  std::vector<std::string> ignored;  // the list of points shows which of them stand out
  try {
    used.fissure = fissureSurfaces(preview.lung().extent, preview.side(),
                                   inputsOf(only(edits, fissure)).given, edits.options, ignored)
                       .at(fissure);
    used.problem.clear();
    preview.set(fissure, used.fissure.surface);
  } catch (const InvalidInput& error) {
    used.problem = qtText(error.what());
  }
}

void FissureEditor::moveToShares(LobePreview& preview, const LobeEdits& edits) {
  const auto shares = edits.shares.find(preview.side());
  if (shares == edits.shares.end() || !valid(shares->second)) return;
  if (!exact()) {
    preview.moveTo(shares->second);
    return;
  }
  for (const Fissure fissure : fissuresOf(preview.side())) {
    const HeightSurface& surface = document_.model().lobes->fissures.at(fissure).surface;
    if (surface.quadratic != preview.surface(fissure).quadratic) preview.set(fissure, surface);
  }
}

std::array<Vec3, 3> FissureEditor::firstHandles(Fissure fissure) const {
  const LobePreview& lung = *preview(side(fissure));
  const TriangleMesh patch = lung.patch(fissure, PatchSpacingMm);
  if (patch.points.size() < 3) {
    const Vec3 middle = lung.lung().extent.bounds.center();
    return {middle, middle + Vec3(20.0, 0.0, 0.0), middle + Vec3(0.0, 20.0, 20.0)};
  }
  // A third of a circle from one another, about as far out as most of the fissure.
  const BestPlane plane =
      bestPlane(std::span(patch.points).first(std::min(patch.points.size(), MostFissurePoints)));
  std::array<Vec3, 3> handles;
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / 3.0 + std::numbers::pi / 2.0;
    handles[i] =
        plane.centre +
        0.7 * plane.scale * (std::cos(angle) * plane.axes[0] + std::sin(angle) * plane.axes[1]);
  }
  return handles;
}

}  // namespace pneuma
