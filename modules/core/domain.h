#pragma once

#include <cstdint>
#include <functional>

#include "core/math.h"

namespace pneuma {

/// A region of space to grow in or to measure: a lobe, a lung, a ball in a test. LPS, mm.
/// All functions may be called from several threads at once.
class Domain {
 public:
  virtual ~Domain() = default;

  virtual bool contains(const Vec3& p) const = 0;

  /// True if every point of the straight segment from `a` to `b` lies inside.
  /// Unless a domain knows better, the segment is sampled every 0.5 mm.
  virtual bool containsSegment(const Vec3& a, const Vec3& b) const;

  /// Distance from `p`, inside or outside, to the region's wall; exact or a lower bound, mm.
  virtual double distanceToWall(const Vec3& p) const = 0;

  /// True only if the whole box lies inside; it may say no to a box that does. Unless a domain
  /// knows better, the wall must be farther from the box's centre than its corners are.
  virtual bool containsBox(const Box3& box) const;

  /// Of the points first + i * stepMm along x, those with bit i set in `wanted` are asked for; bit
  /// i of the answer is set if that point lies inside. A domain with a formula answers a whole row
  /// at once; unless it knows better, every point is asked for alone.
  virtual std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const;

  /// The way from `p`, which lies inside, along the unit vector `direction` to the wall, mm; at
  /// most `farthestMm`. Unless a domain knows better, the way is marched by distanceToWall() with
  /// steps of at least 0.5 mm, and the wall then bisected.
  virtual double exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const;

  /// A box that holds the region.
  virtual Box3 bounds() const = 0;

  virtual double volumeMm3() const = 0;

 protected:
  /// exitDistance() by steps of `clearanceMm` (a lower bound of the distance to the wall) or 0.5
  /// mm.
  double exitByMarching(const Vec3& p, const Vec3& direction, double farthestMm,
                        const std::function<double(const Vec3&)>& clearanceMm) const;
};

}  // namespace pneuma
