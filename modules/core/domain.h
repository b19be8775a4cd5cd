#pragma once

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

  /// A box that holds the region.
  virtual Box3 bounds() const = 0;

  virtual double volumeMm3() const = 0;
};

}  // namespace pneuma
