#include "document/region_editor.h"

#include <algorithm>

#include "core/error.h"
#include "document/breath.h"
#include "document/text.h"

namespace pneuma {

namespace {

constexpr double FirstFactor = 5.0;
constexpr double FirstRadiusMm = 20.0;

}  // namespace

RegionEditor::RegionEditor(Document& document, QObject* parent)
    : QObject(parent), document_(document), factor_(FirstFactor), radiusMm_(FirstRadiusMm) {
  connect(&document_, &Document::changed, this, &RegionEditor::follow);
}

void RegionEditor::follow() {
  if (chosen_ && *chosen_ >= regions().size()) chosen_.reset();
  if (!document_.canBreathe()) placing_ = Placing::Nothing;
  emit changed();
}

void RegionEditor::setPlacing(Placing placing) {
  if (placing == placing_) return;
  placing_ = placing;
  if (placing != Placing::Nothing) chosen_.reset();  // what is set now is for the next one
  emit changed();
}

void RegionEditor::choose(std::optional<std::size_t> region) {
  if (region == chosen_) return;
  chosen_ = region;
  emit changed();
}

double RegionEditor::factor() const { return chosen_ ? regions()[*chosen_].factor : factor_; }

double RegionEditor::radiusMm() const {
  return chosen_ && regions()[*chosen_].isBall() ? regions()[*chosen_].radiusMm : radiusMm_;
}

void RegionEditor::setFactor(double factor) {
  factor_ = std::clamp(factor, LeastStiffness, MostStiffness);
  if (!chosen_) return;
  StiffnessRegion region = regions()[*chosen_];
  region.factor = factor_;
  change(region, tr("change the stiffness"));
}

void RegionEditor::setRadius(double radiusMm) {
  radiusMm_ = radiusMm;
  if (!chosen_ || !regions()[*chosen_].isBall()) return;
  StiffnessRegion region = regions()[*chosen_];
  region.radiusMm = radiusMm;
  change(region, tr("change a ball"));
}

void RegionEditor::change(const StiffnessRegion& region, const QString& what) {
  std::vector<StiffnessRegion> next = regions();
  next[*chosen_] = region;
  document_.setRegions(std::move(next), what);
}

void RegionEditor::placeAt(Lobe lobe, const Vec3& place) {
  if (placing_ == Placing::Nothing || document_.jobs().busy()) return;
  std::vector<StiffnessRegion> next = regions();
  if (placing_ == Placing::Ball) {
    next.push_back({Lobe::Whole, place, radiusMm_, factor_});
    chosen_ = next.size() - 1;
    document_.setRegions(std::move(next), tr("place a ball"));
    return;
  }
  if (lobe == Lobe::RightLung || lobe == Lobe::LeftLung) {
    emit document_.said(tr("This lung is not split into lobes: place a ball instead"));
    return;
  }
  const auto there = std::ranges::find(next, lobe, &StiffnessRegion::lobe);
  chosen_ = static_cast<std::size_t>(there - next.begin());
  if (there == next.end()) {
    next.push_back({lobe, Vec3::Zero(), 0.0, factor_});
  } else {
    there->factor = factor_;
  }
  document_.setRegions(std::move(next), tr("choose a lobe"));
  emit changed();
}

void RegionEditor::removeChosen() {
  if (!chosen_ || document_.jobs().busy()) return;
  std::vector<StiffnessRegion> next = regions();
  next.erase(next.begin() + static_cast<std::ptrdiff_t>(*chosen_));
  chosen_.reset();
  document_.setRegions(std::move(next), tr("remove a region"));
}

QString RegionEditor::textOf(const StiffnessRegion& region) const {
  const QString what = region.isBall() ? tr("Ball of %1").arg(withUnit(region.radiusMm, 0, "mm"))
                                       : capitalised(longName(region.lobe));
  return QStringLiteral("%1, %2 ×").arg(what).arg(region.factor);
}

std::vector<SceneBall> RegionEditor::balls() const {
  std::vector<SceneBall> balls;
  const auto& breath = document_.snapshot().breath;
  for (std::size_t i = 0; i < regions().size(); ++i) {
    const StiffnessRegion& region = regions()[i];
    if (!region.isBall()) continue;
    SceneBall ball{region.centre, region.radiusMm, region.factor >= 1.0, chosen_ == i};
    if (breath) {
      ball.side = sideOf(region, document_.model());
      const auto motion = breath->lungs.motion.find(ball.side);
      if (motion != breath->lungs.motion.end()) ball.displacement = motion->second.at(ball.centre);
    }
    balls.push_back(ball);
  }
  return balls;
}

}  // namespace pneuma
