#include "document/fissure_editor.h"

#include <algorithm>
#include <cmath>
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
constexpr double DrawnHandlesShare = 0.7;  ///< of the plane's scale
constexpr double FarthestExtendMm = 15.0;

/// As the window lists them.
constexpr std::array<Fissure, 3> Order = {Fissure::LeftOblique, Fissure::RightOblique,
                                          Fissure::RightHorizontal};

bool valid(const LobeShares& shares) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  return std::abs(sum - 1.0) <= ShareTolerance &&
         std::ranges::all_of(shares, [](double share) { return share > 0.0; });
}

/// What is given of one fissure, and of the one that a surface from a file ends at.
GivenFissures givenFor(Fissure fissure, const LobeEdits& edits) {
  GivenFissures given = inputsOf(concerning(edits, fissure)).given;
  const auto own = given.find(fissure);
  const bool byPatch = own != given.end() && own->second.patch;
  if (byPatch && fissure == Fissure::RightHorizontal) {
    given.merge(inputsOf(concerning(edits, Fissure::RightOblique)).given);
  }
  return given;
}

bool same(const HeightSurface& a, const HeightSurface& b) {
  return a.centre == b.centre && a.quadratic == b.quadratic && a.weights == b.weights;
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

std::vector<Vec3> FissureEditor::points(Fissure fissure) const {
  const std::vector<Vec3>& set = edit(fissure).points;
  const auto found = used_.find(fissure);
  const bool known = found != used_.end() && found->second.points.size() == set.size();
  return known ? found->second.points : set;
}

const TracedFissure* FissureEditor::traced(Fissure fissure) const {
  const auto found = used_.find(fissure);
  if (found == used_.end() || !found->second.from) return nullptr;
  return &found->second.from->fissures.at(fissure);
}

std::shared_ptr<const ShownParts> FissureEditor::shownParts(Fissure fissure) const {
  const auto found = used_.find(fissure);
  if (found == used_.end() || !found->second.from) return nullptr;
  const auto parts = found->second.from->parts.find(fissure);
  return parts == found->second.from->parts.end() ? nullptr : parts->second;
}

bool FissureEditor::canExtend(Fissure fissure) const {
  const auto found = used_.find(fissure);
  return found != used_.end() && found->second.canExtend;
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
    const bool byPoints = edit(fissure).method == FissureMethod::Points;
    const std::vector<Vec3> places = byPoints ? points(fissure) : marksOf(edit(fissure));
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
  commit(edits, method == FissureMethod::Plane     ? tr("take a plane")
                : method == FissureMethod::Surface ? tr("take a surface")
                                                   : tr("take points"));
}

void FissureEditor::addPoint(const Vec3& point) {
  if (edit(current_).method != FissureMethod::Points || !available()) return;
  LobeEdits edits = document_.snapshot().lobeEdits;
  edits.fissures[current_].points.push_back(point);
  edits.fissures[current_].weights.push_back(UsualWeight);
  commit(edits, tr("set a point"));
}

void FissureEditor::removePoint(Fissure fissure, std::size_t index) {
  LobeEdits edits = document_.snapshot().lobeEdits;
  FissureEdit& edit = edits.fissures[fissure];
  if (edit.method != FissureMethod::Points || index >= edit.points.size()) return;
  edit.points.erase(edit.points.begin() + static_cast<std::ptrdiff_t>(index));
  edit.weights.erase(edit.weights.begin() + static_cast<std::ptrdiff_t>(index));
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

void FissureEditor::setWeight(Fissure fissure, std::size_t index, double weight) {
  LobeEdits edits = document_.snapshot().lobeEdits;
  FissureEdit& edit = edits.fissures[fissure];
  if (index >= edit.weights.size()) return;
  edit.weights[index] = weight;
  commit(edits, tr("weigh a point"));
}

void FissureEditor::setAngles(Fissure fissure, const PlaneAngles& angles) {
  LobeEdits edits = document_.snapshot().lobeEdits;
  FissureEdit& edit = edits.fissures[fissure];
  if (!edit.handles) return;
  edit.handles = turnedTo(angles, *edit.handles);
  commit(edits, tr("turn a plane"));
}

void FissureEditor::extendSurfaces() {
  LobeEdits edits = document_.snapshot().lobeEdits;
  edits.options.extendMm = FarthestExtendMm;
  commit(edits, tr("extend a surface"));
}

void FissureEditor::setShares(const std::map<Side, LobeShares>& shares) {
  LobeEdits edits = document_.snapshot().lobeEdits;
  edits.shares = shares;
  if (!shares.empty()) edits.snap = false;  // they move the fissures off what shows
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
  const LobeEdits before = std::exchange(draft_, edits);
  const auto& traces = document_.snapshot().traces;
  const bool traced = traces && traces->edits == edits;
  for (LobePreview& preview : previews_) {
    for (const Fissure fissure : fissuresOf(preview.side())) {
      if (traced && traces->fissures.contains(fissure)) {
        adopt(fissure, preview, traces);
      } else if (isOther(fissure, before, edits)) {
        workOut(fissure, preview, edits);
      }
    }
    moveToShares(preview, edits);
  }
  emit changed();
}

bool FissureEditor::isOther(Fissure fissure, const LobeEdits& before, const LobeEdits& now) const {
  const LobeEdits old = concerning(before, fissure);
  const LobeEdits own = concerning(now, fissure);
  if (old == own) return false;
  if (old.fissures != own.fissures || old.shares != own.shares || old.snap != own.snap) return true;
  // By the options alone: those do not matter to what shows in the CT, and little to a file.
  const FissureEdit& set = edit(fissure);
  if (set.method == FissureMethod::Surface) return old.options.extendMm != own.options.extendMm;
  return !own.snap ||
         (set.method == FissureMethod::Points && set.points.size() >= LeastFissurePoints);
}

void FissureEditor::adopt(Fissure fissure, LobePreview& preview,
                          const std::shared_ptr<const FissureTraces>& traces) {
  Used& used = used_[fissure];
  if (used.from == traces) return;
  const TracedFissure& traced = traces->fissures.at(fissure);
  used = {traced.used, traced.points, {}, false, traces};
  if (!same(preview.surface(fissure), traced.used.surface)) {
    preview.set(fissure, traced.used.surface);
  }
}

UsedFissure FissureEditor::surfaceOf(Fissure fissure, const LobePreview& preview,
                                     const LobeOptions& options, GivenFissures& given) const {
  std::vector<std::string> ignored;  // the list of points shows which of them stand out
  const LungExtent& extent = preview.lung().extent;
  UsedFissure used = fissureSurfaces(extent, preview.side(), given, options, ignored).at(fissure);
  const auto own = given.find(fissure);
  const auto sheets = document_.sheets(preview.side());
  if (!draft_.snap || !sheets || own == given.end() || own->second.points.empty()) return used;
  own->second.points = snapPoints(*sheets, used.surface, own->second.points).points;
  return fissureSurfaces(extent, preview.side(), given, options, ignored).at(fissure);
}

void FissureEditor::workOut(Fissure fissure, LobePreview& preview, const LobeEdits& edits) {
  Used& used = used_[fissure];
  used.from = nullptr;
  used.points.clear();
  used.canExtend = false;
  try {
    GivenFissures given = givenFor(fissure, edits);
    used.fissure = surfaceOf(fissure, preview, edits.options, given);
    const auto own = given.find(fissure);
    if (own != given.end()) used.points = own->second.points;
    used.problem.clear();
    preview.set(fissure, used.fissure.surface);
  } catch (const InvalidInput& error) {
    used.problem = qtText(error.what());
    used.canExtend = wouldReach(fissure, preview, edits);
  }
}

bool FissureEditor::wouldReach(Fissure fissure, const LobePreview& preview, LobeEdits edits) const {
  if (edit(fissure).method != FissureMethod::Surface) return false;
  if (edits.options.extendMm >= FarthestExtendMm) return false;
  edits.options.extendMm = FarthestExtendMm;
  try {
    GivenFissures given = givenFor(fissure, edits);
    surfaceOf(fissure, preview, edits.options, given);
    return true;
  } catch (const InvalidInput&) {
    return false;
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
  // About as far out as most of the fissure.
  const BestPlane plane =
      bestPlane(std::span(patch.points).first(std::min(patch.points.size(), MostFissurePoints)));
  return handlesAround(plane.centre, plane.axes[0], plane.axes[1], DrawnHandlesShare * plane.scale);
}

}  // namespace pneuma
