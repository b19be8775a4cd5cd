#pragma once

#include <vector>

#include "lobes/height_surface.h"

namespace pneuma {

/// A height surface looked up between points 1 mm apart, for millions of places: 0.011 mm from the
/// formula, and by the formula itself where the sign might suffer.
class HeightTable {
 public:
  /// @param box outside of which nobody asks, LPS, mm
  HeightTable(const HeightSurface& surface, const Box3& box);

  /// HeightSurface::height() of a point; where it may be zero, by the formula.
  double height(const Vec3& p) const {
    const Vec2 uv = surface_.planar(p);
    const double h = (p - surface_.centre).dot(surface_.axes[2]) - lift(uv);
    return h > SureMm || h < -SureMm ? h : surface_.height(p);
  }

  /// True if the point lies below the surface: the sign of HeightSurface::height().
  bool below(const Vec3& p) const { return height(p) < 0.0; }

 private:
  static constexpr double SureMm = 0.1;

  double lift(const Vec2& uv) const {
    const Vec2 at = (uv - low_).cwiseMax(0.0).cwiseMin(most_);
    const auto i = static_cast<std::size_t>(at.x());
    const auto j = static_cast<std::size_t>(at.y());
    const double a = at.x() - static_cast<double>(i);
    const double b = at.y() - static_cast<double>(j);
    const double* w = &lift_[i + columns_ * j];
    return (1.0 - b) * ((1.0 - a) * w[0] + a * w[1]) +
           b * ((1.0 - a) * w[columns_] + a * w[columns_ + 1]);
  }

  HeightSurface surface_;
  Vec2 low_ = Vec2::Zero();   ///< of the table, mm
  Vec2 most_ = Vec2::Zero();  ///< largest place in it, from `low_`
  std::size_t columns_ = 0;
  std::vector<double> lift_;  ///< mm
};

}  // namespace pneuma
