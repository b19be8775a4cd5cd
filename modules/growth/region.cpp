#include "growth/region.h"

#include <algorithm>
#include <limits>

namespace pneuma {
namespace {

constexpr double Infinite = std::numeric_limits<double>::infinity();

/// A branching point lies on the planes that were laid through it, up to rounding, mm.
constexpr double OnPlaneMm = 1e-9;

/// The part of a ray that lies in a half-space: from `enter` to `exit`.
struct Interval {
  double enter = 0.0;
  double exit = 0.0;
};

Interval inHalfSpace(double depth, double slope) {
  if (depth >= -OnPlaneMm) {
    return {0.0, slope < 0.0 ? std::max(depth, 0.0) / -slope : Infinite};
  }
  return slope > 0.0 ? Interval{-depth / slope, Infinite} : Interval{Infinite, Infinite};
}

}  // namespace

bool Wedge::contains(const Vec3& p) const {
  const Vec3 way = p - point;
  const bool inFirst = first.dot(way) >= 0.0;
  if (kind == WedgeKind::Plane) return inFirst;
  const bool inSecond = second.dot(way) >= 0.0;
  return kind == WedgeKind::Both ? inFirst && inSecond : inFirst || inSecond;
}

double Wedge::exitDistance(const Vec3& p, const Vec3& direction) const {
  const Vec3 way = p - point;
  const Interval a = inHalfSpace(first.dot(way), first.dot(direction));
  if (kind == WedgeKind::Plane) return a.enter > 0.0 ? 0.0 : a.exit;
  const Interval b = inHalfSpace(second.dot(way), second.dot(direction));
  if (kind == WedgeKind::Both)
    return a.enter > 0.0 || b.enter > 0.0 ? 0.0 : std::min(a.exit, b.exit);
  // The union: where one is left, the other may have been entered.
  const Interval& sooner = a.enter <= b.enter ? a : b;
  const Interval& later = a.enter <= b.enter ? b : a;
  if (sooner.enter > 0.0) return 0.0;
  return later.enter <= sooner.exit ? std::max(sooner.exit, later.exit) : sooner.exit;
}

Wedge Wedge::rest() const {
  const WedgeKind other = kind == WedgeKind::Plane  ? WedgeKind::Plane
                          : kind == WedgeKind::Both ? WedgeKind::Either
                                                    : WedgeKind::Both;
  return {other, point, -first, -second};
}

bool Region::contains(const Vec3& p) const {
  if (!std::ranges::all_of(walls, [&](const Wedge& wall) { return wall.contains(p); }))
    return false;
  return (!organCuts && box.contains(p)) || organ->contains(p);
}

double Region::exitDistance(const Vec3& p, const Vec3& direction) const {
  double distance = organ->bounds().diagonal().norm();
  for (const Wedge& wall : walls) distance = std::min(distance, wall.exitDistance(p, direction));
  if (distance <= 0.0) return 0.0;
  if (!organCuts && box.contains(p) && box.contains(Vec3(p + distance * direction)))
    return distance;
  return organ->exitDistance(p, direction, distance);
}

}  // namespace pneuma
