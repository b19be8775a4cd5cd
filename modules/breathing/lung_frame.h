#pragma once

#include "anatomy/lobe.h"
#include "core/math.h"

namespace pneuma {

/// The frame of one lung in Santhanam 2008: X from the heart to the side, Y from the back to the
/// front, Z from the apex to the base; mirrored between right and left. Places in it are shares of
/// the box around the lung at rest, one box for all of its lobes: with a box for each, fissures
/// would open.
class LungFrame {
 public:
  /// @param box of the lung's surface, LPS, mm, not empty
  LungFrame(Side side, const Box3& box) : side_(side), box_(box) {}

  Side side() const { return side_; }

  /// Lengths of the box along X, Y and Z, mm.
  Vec3 lengths() const { return box_.sizes(); }

  /// Shares of the box; outside of it they are below 0 or above 1.
  Vec3 shareOf(const Vec3& p) const {
    const Vec3& low = box_.min();
    const Vec3& high = box_.max();
    const double x = side_ == Side::Right ? high.x() - p.x() : p.x() - low.x();
    return Vec3(x, high.y() - p.y(), high.z() - p.z()).cwiseQuotient(lengths());
  }

  /// A vector with parts along X, Y and Z as one in LPS.
  Vec3 toLps(const Vec3& v) const {
    return {side_ == Side::Right ? -v.x() : v.x(), -v.y(), -v.z()};
  }

  /// toLps() as a matrix, which is its own inverse.
  Eigen::Matrix3d axes() const { return toLps(Vec3::Ones()).asDiagonal(); }

 private:
  Side side_;
  Box3 box_;
};

}  // namespace pneuma
