#include "document/review_walk.h"

#include <algorithm>
#include <cmath>

#include "document/text.h"
#include "pipeline/review_stations.h"

namespace pneuma {

namespace {

constexpr double PatchSpacingMm = 5.0;
constexpr double MovedMm = 1.0;  ///< farther from where it looked right it is looked at again

}  // namespace

ReviewWalk::ReviewWalk(Document& document, FissureEditor& editor, SliceViews& slices,
                       QObject* parent)
    : QObject(parent), document_(document), editor_(editor), slices_(slices) {
  connect(&document_, &Document::changed, this, [this] {
    if (document_.snapshot().lungs != lungs_) {
      stations_.clear();
      at_.reset();
      lungs_ = document_.snapshot().lungs;
    }
    emit changed();
  });
}

std::size_t ReviewWalk::passed() const {
  return static_cast<std::size_t>(std::ranges::count(stations_, true, &Station::passed));
}

bool ReviewWalk::complete() const {
  const std::vector<Fissure> there = editor_.fissures();
  return !there.empty() && std::ranges::all_of(there, [this](Fissure fissure) {
    return document_.reviewed(fissure);
  });
}

std::optional<Fissure> ReviewWalk::nextFissure() const {
  const std::vector<Fissure> there = editor_.fissures();
  if (!document_.reviewed(editor_.current())) return editor_.current();
  const auto next =
      std::ranges::find_if(there, [this](Fissure fissure) { return !document_.reviewed(fissure); });
  return next == there.end() ? std::nullopt : std::optional(*next);
}

void ReviewWalk::start() {
  if (!available()) return;
  // Who asks again for a review that is over wants to see it once more.
  begin(nextFissure().value_or(editor_.current()));
}

void ReviewWalk::begin(Fissure fissure) {
  editor_.setPlacing(false);
  editor_.setCurrent(fissure);
  if (stations_.empty() || fissure != fissure_ || passed() == stations_.size()) {
    fissure_ = fissure;
    stations_.clear();
    const TriangleMesh patch = editor_.preview(side(fissure))->patch(fissure, PatchSpacingMm);
    for (const Vec3& place : reviewStations(patch, editor_.points(fissure))) {
      stations_.push_back({place, false});
    }
  }
  refresh();
  goOn();
  emit changed();
}

void ReviewWalk::refresh() {
  const HeightSurface& surface = editor_.preview(side(fissure_))->surface(fissure_);
  for (Station& station : stations_) {
    const double away = surface.distance(station.place);
    station.place -= away * surface.normalAt(surface.planar(station.place));
    station.passed = station.passed && std::abs(away) <= MovedMm;
  }
}

bool ReviewWalk::goOn() {
  const auto next = std::ranges::find(stations_, false, &Station::passed);
  if (next == stations_.end()) {
    at_.reset();
    return false;
  }
  at_ = static_cast<std::size_t>(next - stations_.begin());
  slices_.moveTo(next->place);
  return true;
}

void ReviewWalk::looksRight() {
  if (!active()) return;
  refresh();
  stations_[*at_].passed = true;
  if (!goOn()) {
    document_.setReviewed({fissure_}, false);
    if (const auto next = nextFissure(); next && document_.reviewed(fissure_)) begin(*next);
  }
  emit changed();
}

void ReviewWalk::editHere() {
  if (!active()) return;
  at_.reset();
  editor_.setCurrent(fissure_);
  editor_.setPlacing(editor_.edit(fissure_).method == FissureMethod::Points);
  emit changed();
}

void ReviewWalk::stop() {
  if (!active()) return;
  at_.reset();
  emit changed();
}

void ReviewWalk::accept() {
  at_.reset();
  std::vector<Fissure> unseen;
  for (const Fissure fissure : editor_.fissures()) {
    if (!document_.reviewed(fissure)) unseen.push_back(fissure);
  }
  document_.setReviewed(unseen, true);
  emit changed();
}

}  // namespace pneuma
