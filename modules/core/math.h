#pragma once

#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pneuma {

/// A point or vector in patient LPS coordinates (x to the left, y to the back, z up), mm.
using Vec3 = Eigen::Vector3d;

/// An axis-aligned box, mm.
using Box3 = Eigen::AlignedBox3d;

/// Angle between two vectors in [0, pi], radians; 0 if one of them has no length.
inline double angleBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// `v` turned by `angle` radians about the unit vector `axis` (Rodrigues).
inline Vec3 rotated(const Vec3& v, const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis) * v;
}

/// A unit vector perpendicular to the unit vector `d`, the same one for the same `d`.
inline Vec3 anyPerpendicular(const Vec3& d) { return d.unitOrthogonal(); }

}  // namespace pneuma
