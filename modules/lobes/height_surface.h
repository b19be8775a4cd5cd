#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/math.h"

namespace pneuma {

using Vec2 = Eigen::Vector2d;

/// A fissure as a height over a plane: at (u, v) in that plane it lies at
///   w = c0 + c1 a + c2 b + c3 a^2 + c4 a b + c5 b^2 + sum_i weight_i r_i^2 ln r_i,
/// a = u / scale, b = v / scale, r_i the distance of (a, b) from knot i: a thin-plate spline
/// (Duchon 1977) upon a quadratic. It has no end: beyond its points it goes on by the same formula.
struct HeightSurface {
  Vec3 centre = Vec3::Zero();  ///< where u = v = 0, LPS, mm
  std::array<Vec3, 3> axes{Vec3::UnitX(), Vec3::UnitY(),
                           Vec3::UnitZ()};  ///< u, v, normal; right-handed
  double scale = 1.0;                       ///< mm
  std::array<double, 6> quadratic{};        ///< c0 .. c5, mm
  std::vector<Vec2> knots;                  ///< (a, b)
  std::vector<double> weights;              ///< of the knots, mm

  const Vec3& normal() const { return axes[2]; }

  /// (u, v) of a point, mm.
  Vec2 planar(const Vec3& p) const {
    return {(p - centre).dot(axes[0]), (p - centre).dot(axes[1])};
  }

  /// w at (u, v), mm.
  double lift(const Vec2& uv) const;

  /// Derivatives of w along u and v.
  Vec2 slope(const Vec2& uv) const;

  /// Normal of the surface itself at (u, v), of length 1.
  Vec3 normalAt(const Vec2& uv) const;

  /// How far a point lies above the surface along the normal, mm; negative below.
  double height(const Vec3& p) const { return (p - centre).dot(axes[2]) - lift(planar(p)); }

  /// The same as a distance from the surface, to first order, mm.
  double distance(const Vec3& p) const;

  /// The point of the surface at (u, v).
  Vec3 at(const Vec2& uv) const {
    return centre + uv.x() * axes[0] + uv.y() * axes[1] + lift(uv) * axes[2];
  }
};

}  // namespace pneuma
