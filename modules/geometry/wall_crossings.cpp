#include "geometry/wall_crossings.h"

#include <cmath>

namespace pneuma {
namespace {

/// Sign of the determinant of three differences of points; 0 if rounding could decide it.
int certainSign(const Vec3& u, const Vec3& v, const Vec3& w) {
  // Shewchuk 1997, Adaptive precision floating-point arithmetic, bound A of orient3d
  constexpr double Unit = 0x1.0p-53;
  constexpr double Bound = (7.0 + 56.0 * Unit) * Unit;
  const double vw = v.x() * w.y();
  const double wv = w.x() * v.y();
  const double wu = w.x() * u.y();
  const double uw = u.x() * w.y();
  const double uv = u.x() * v.y();
  const double vu = v.x() * u.y();
  const double determinant = u.z() * (vw - wv) + v.z() * (wu - uw) + w.z() * (uv - vu);
  const double permanent = std::abs(u.z()) * (std::abs(vw) + std::abs(wv)) +
                           std::abs(v.z()) * (std::abs(wu) + std::abs(uw)) +
                           std::abs(w.z()) * (std::abs(uv) + std::abs(vu));
  const double error = Bound * permanent;
  return determinant > error ? 1 : determinant < -error ? -1 : 0;
}

Crossings crossings(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& triangle) {
  // The line passes the three edges on the same side, and the ends lie on two sides of the plane.
  const Vec3 way = q - p;
  const Vec3 a = triangle[0] - p;
  const Vec3 b = triangle[1] - p;
  const Vec3 c = triangle[2] - p;
  const int ab = certainSign(way, a, b);
  const int bc = certainSign(way, b, c);
  if (ab * bc < 0) return Crossings::Even;
  const int ca = certainSign(way, c, a);
  if (ab * ca < 0 || bc * ca < 0) return Crossings::Even;
  const int ofP = certainSign(a, b, c);
  const int ofQ = certainSign(triangle[0] - q, triangle[1] - q, triangle[2] - q);
  if (ofP * ofQ > 0) return Crossings::Even;
  return ofP * ofQ * ab * bc * ca == 0 ? Crossings::Unsure : Crossings::Odd;
}

}  // namespace

WallCrossings::WallCrossings(const TriangleMesh& mesh) {
  corners_.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    corners_.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
  }
}

Crossings WallCrossings::parity(const Vec3& p, const Vec3& q,
                                std::span<const std::uint32_t> triangles) const {
  Crossings sum = Crossings::Even;
  for (const std::uint32_t t : triangles) {
    sum = sum + of(p, q, t);
    if (sum == Crossings::Unsure) break;
  }
  return sum;
}

Crossings WallCrossings::of(const Vec3& p, const Vec3& q, std::uint32_t triangle) const {
  return crossings(p, q, corners_[triangle]);
}

}  // namespace pneuma
