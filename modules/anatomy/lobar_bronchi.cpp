#include "anatomy/lobar_bronchi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "anatomy/centreline.h"
#include "core/error.h"
#include "core/units.h"

namespace pneuma {
namespace {

/// A point on the centreline of a branch.
struct Place {
  std::size_t branch = 0;
  double alongMm = 0.0;  ///< from its proximal end
  Vec3 position = Vec3::Zero();
};

/// The points of a branch's centreline, ends included, with the way to each.
std::vector<Place> pointsOf(const AirwayTree& tree, std::size_t branch) {
  constexpr double StepMm = 1.0;
  std::vector<Place> points = {{branch, 0.0, tree[branch].proximal}};
  double along = 0.0;
  forEachPiece(tree[branch], [&](const CentrelinePiece& piece) {
    const double length = (piece.to - piece.from).norm();
    const double steps = std::max(std::ceil(length / StepMm), 1.0);
    for (double step = 1.0; step <= steps; ++step) {
      const double part = step / steps;
      points.push_back(
          {branch, along + part * length, piece.from + part * (piece.to - piece.from)});
    }
    along += length;
  });
  return points;
}

std::optional<std::size_t> regionAt(std::span<const LobeRegion> lobes, const Vec3& p) {
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    if (lobes[i].domain->contains(p)) return i;
  }
  return std::nullopt;
}

/// The part of a branch from one way along its centreline to another; its ends are points of it.
Branch partOf(const Branch& branch, const Place& from, const Place& to) {
  Branch part = branch;
  part.proximal = from.position;
  part.distal = to.position;
  part.via.clear();
  double along = 0.0;
  Vec3 before = branch.proximal;
  for (const CentrelinePoint& point : branch.via) {
    along += (point.position - before).norm();
    before = point.position;
    if (along > from.alongMm + 1e-6 && along < to.alongMm - 1e-6) part.via.push_back(point);
  }
  return part;
}

/// Adds a straight branch that leaves the tree at `place`.
AirwayTree withBranchAt(const AirwayTree& tree, const Place& place, const Vec3& end, Lobe lobe) {
  constexpr double SnapMm = 2.0;  // nearer to an end, the branch leaves from there
  const Branch& from = tree[place.branch];
  Branch added;
  added.distal = end;
  added.radiusMm = from.radiusMm * std::cbrt(0.5);
  added.lobe = lobe;
  added.origin = Origin::Template;
  const double length = lengthMm(from);
  const bool atEnd = length - place.alongMm < SnapMm;
  const bool atStart = !atEnd && place.alongMm < SnapMm && from.parent >= 0;
  if (atEnd || atStart) {
    AirwayTree result = tree;
    added.parent = atEnd ? static_cast<int>(place.branch) : from.parent;
    added.proximal = atEnd ? from.distal : from.proximal;
    result.add(std::move(added));
    return result;
  }
  // Branches behind the divided one move by one place.
  AirwayTree result;
  result.reserve(tree.size() + 2);
  const auto moved = [&](int branch) {
    return branch >= static_cast<int>(place.branch) ? branch + 1 : branch;
  };
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (i == place.branch) {
      Branch upper = partOf(from, {i, 0.0, from.proximal}, place);
      upper.suppliedMl = 0.0;
      upper.ending = Ending::None;
      added.parent = result.add(std::move(upper));
      Branch lower = partOf(from, place, {i, length, from.distal});
      lower.parent = added.parent;
      result.add(std::move(lower));
      continue;
    }
    Branch branch = tree[i];
    branch.parent = branch.parent < 0 ? -1 : moved(branch.parent);
    result.add(std::move(branch));
  }
  added.proximal = place.position;
  result.add(std::move(added));
  return result;
}

/// Where an airway leaves a tree for a lobe.
class Departure {
 public:
  Departure(const AirwayTree& tree, std::span<const LobeRegion> lobes,
            std::span<const Vec3> centres, std::size_t region)
      : tree_(tree),
        children_(tree),
        lobes_(lobes),
        centres_(centres),
        centre_(centres[region]),
        lobe_(lobes[region].lobe),
        sides_(tree.size(), std::nullopt) {
    findSides();
  }

  Place place() const {
    if (const auto end = ownEnd()) return *end;
    const double mainMm = mainBronchusMm(side(lobe_)) * bronchialScale(lobes_);
    const bool sideKnown = side(lobe_) != Side::None;
    if (sideKnown) {
      for (const bool clear : {true, false}) {
        if (const auto found = nearest(mainMm, clear, true)) return *found;
      }
      if (const auto found = farthest()) return *found;
      if (const auto found = carina()) return *found;
    }
    if (const auto found = nearest(0.0, true, false)) return *found;
    if (const auto found = nearest(0.0, false, false)) return *found;
    return {0, lengthMm(tree_[0]) / 2.0, (tree_[0].proximal + tree_[0].distal) / 2.0};
  }

 private:
  /// The side of a branch is that of all ends below it; Side::None if they differ. An end is on the
  /// side of the lobe that holds it, else of the one whose centre is nearest.
  void findSides() {
    for (std::size_t i = tree_.size(); i-- > 0;) {
      if (children_.isTerminal(i)) sides_[i] = sideOfEnd(tree_[i].distal);
      if (tree_[i].parent < 0) continue;
      std::optional<Side>& above = sides_[static_cast<std::size_t>(tree_[i].parent)];
      above = !above.has_value() || above == sides_[i] ? sides_[i] : Side::None;
    }
  }

  Side sideOfEnd(const Vec3& end) const {
    if (const auto region = regionAt(lobes_, end)) return side(lobes_[*region].lobe);
    const auto nearest = std::ranges::min_element(
        centres_, {}, [&](const Vec3& centre) { return (centre - end).squaredNorm(); });
    return side(lobes_[static_cast<std::size_t>(nearest - centres_.begin())].lobe);
  }

  /// An end marked with the lobe that lies in none.
  std::optional<Place> ownEnd() const {
    std::optional<Place> best;
    for (std::size_t i = 0; i < tree_.size(); ++i) {
      const Vec3& end = tree_[i].distal;
      if (!children_.isTerminal(i) || tree_[i].lobe != lobe_ || regionAt(lobes_, end)) continue;
      if (best && (end - centre_).norm() >= (best->position - centre_).norm()) continue;
      best = Place{i, lengthMm(tree_[i]), end};
    }
    return best;
  }

  bool isOnSide(std::size_t branch) const { return sides_[branch] == side(lobe_); }

  /// The way from the first branch that serves this side only, the main bronchus, to the start of
  /// this one.
  double wayFromCarina(std::size_t branch) const {
    double way = 0.0;
    for (int above = tree_[branch].parent; above >= 0;
         above = tree_[static_cast<std::size_t>(above)].parent) {
      if (!isOnSide(static_cast<std::size_t>(above))) break;
      way += lengthMm(tree_[static_cast<std::size_t>(above)]);
    }
    return way;
  }

  /// An airway must not go on from an end that a lobe is grown from.
  bool isInletEnd(const Place& place) const {
    return children_.isTerminal(place.branch) &&
           lengthMm(tree_[place.branch]) - place.alongMm < 3.0 &&
           regionAt(lobes_, tree_[place.branch].distal).has_value();
  }

  template <class F>
  void forEachPlace(bool onSide, F&& f) const {
    for (std::size_t i = 0; i < tree_.size(); ++i) {
      if (onSide && !isOnSide(i)) continue;
      const double way = wayFromCarina(i);
      for (const Place& place : pointsOf(tree_, i)) {
        if (!isInletEnd(place)) f(place, way + place.alongMm);
      }
    }
  }

  std::optional<Place> nearest(double leastWayMm, bool clearOfLobes, bool onSide) const {
    std::optional<Place> best;
    double bestMm = std::numeric_limits<double>::infinity();
    forEachPlace(onSide, [&](const Place& place, double way) {
      const double mm = (place.position - centre_).norm();
      if (way < leastWayMm || mm >= bestMm) return;
      if (clearOfLobes && regionAt(lobes_, place.position)) return;
      best = place;
      bestMm = mm;
    });
    return best;
  }

  /// As far from the carina as the airways of this side go: they end within the main bronchus.
  std::optional<Place> farthest() const {
    std::optional<Place> best;
    double bestMm = -1.0;
    forEachPlace(true, [&](const Place& place, double way) {
      if (way <= bestMm) return;
      best = place;
      bestMm = way;
    });
    return best;
  }

  /// Where the airways of both sides part.
  std::optional<Place> carina() const {
    for (std::size_t i = 0; i < tree_.size(); ++i) {
      if (children_.of(i).size() < 2) continue;
      return Place{i, lengthMm(tree_[i]), tree_[i].distal};
    }
    return std::nullopt;
  }

  const AirwayTree& tree_;
  Children children_;
  std::span<const LobeRegion> lobes_;
  std::span<const Vec3> centres_;
  Vec3 centre_;
  Lobe lobe_;
  std::vector<std::optional<Side>> sides_;
};

std::vector<char> lobesWithEnds(const AirwayTree& tree, std::span<const LobeRegion> lobes) {
  const Children children(tree);
  std::vector<char> with(lobes.size(), 0);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!children.isTerminal(i)) continue;
    if (const auto region = regionAt(lobes, tree[i].distal)) with[*region] = 1;
  }
  return with;
}

}  // namespace

Vec3 innerCentre(const LobeRegion& region) {
  const Box3 box = region.domain->bounds();
  const double step = std::max(box.sizes().maxCoeff() / 40.0, 1e-9);
  std::vector<Vec3> inside;
  Vec3 sum = Vec3::Zero();
  for (double x = box.min().x() + 0.37 * step; x < box.max().x(); x += step)
    for (double y = box.min().y() + 0.29 * step; y < box.max().y(); y += step)
      for (double z = box.min().z() + 0.43 * step; z < box.max().z(); z += step) {
        const Vec3 p(x, y, z);
        if (!region.domain->contains(p)) continue;
        inside.push_back(p);
        sum += p;
      }
  if (inside.empty()) {
    throw InvalidInput("the " + std::string(longName(region.lobe)) +
                       " is too thin or too small to grow airways in");
  }
  const Vec3 mean = sum / static_cast<double>(inside.size());
  if (region.domain->contains(mean)) return mean;
  return *std::ranges::min_element(inside, {},
                                   [&](const Vec3& p) { return (p - mean).squaredNorm(); });
}

double mainBronchusMm(Side side) {
  return side == Side::Right ? 24.4 : side == Side::Left ? 47.6 : 0.0;
}

double lobarBronchusMm(Lobe lobe) {
  return lobe == Lobe::RightMiddle ? 18.0 : lobe == Lobe::RightLower ? 26.7 : 16.9;
}

double bronchialScale(std::span<const LobeRegion> lobes) {
  double volume = 0.0;
  bool right = false;
  bool left = false;
  for (const LobeRegion& region : lobes) {
    volume += region.domain->volumeMm3();
    (side(region.lobe) == Side::Left ? left : right) = true;
  }
  const double lungs = (right ? 1.0 : 0.0) + (left ? 1.0 : 0.0);
  return std::cbrt(millilitres(volume) / lungs / 3500.0);
}

Vec3 lobarEnd(const Domain& lobe, const Vec3& from, const Vec3& centre, double lengthMm,
              double furtherMm) {
  const Vec3 way = centre - from;
  const double whole = way.norm();
  double length = std::min(lengthMm, 0.9 * whole);
  while (length < whole && !lobe.contains(from + way * (length / whole))) length += 1.0;
  const double further = std::min(length + furtherMm, whole);
  if (lobe.contains(from + way * (further / whole))) length = further;
  length = std::min(length, whole);
  return from + way * (length / whole);
}

LedAirways ledIntoLobes(const AirwayTree& central, std::span<const LobeRegion> lobes) {
  LedAirways led{central, {}};
  if (central.empty()) return led;
  const std::vector<char> with = lobesWithEnds(central, lobes);
  if (std::ranges::count(with, 0) == 0 || std::ranges::count(with, 1) == 0) return led;
  std::vector<Vec3> centres;
  for (const LobeRegion& region : lobes) centres.push_back(innerCentre(region));
  const double scale = bronchialScale(lobes);
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    if (with[i] != 0) continue;
    const Place place = Departure(led.airways, lobes, centres, i).place();
    const Vec3 end = lobarEnd(*lobes[i].domain, place.position, centres[i],
                              lobarBronchusMm(lobes[i].lobe) * scale, 3.0 * scale);
    led.airways = withBranchAt(led.airways, place, end, lobes[i].lobe);
    led.lobes.push_back(lobes[i].lobe);
  }
  return led;
}

}  // namespace pneuma
