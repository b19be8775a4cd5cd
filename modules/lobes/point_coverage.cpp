#include "lobes/point_coverage.h"

#include <algorithm>
#include <vector>

namespace pneuma {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Counter-clockwise (Andrew 1979).
std::vector<Vec2> convexHull(std::vector<Vec2> points) {
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::ranges::sort(points, before);
  std::vector<Vec2> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();  // begins the other half
    std::ranges::reverse(points);
  }
  return hull;
}

}  // namespace

double pointCoverage(std::span<const Vec3> points, const HeightSurface& surface,
                     const TriangleMesh& contact) {
  std::vector<Vec2> planar;
  for (const Vec3& p : points) planar.push_back(surface.planar(p));
  const std::vector<Vec2> hull = convexHull(std::move(planar));
  const auto inside = [&](const Vec2& p) {
    for (std::size_t i = 0; i < hull.size(); ++i) {
      if (turn(hull[i], hull[(i + 1) % hull.size()], p) < 0.0) return false;
    }
    return hull.size() > 2;
  };
  double covered = 0.0;
  double whole = 0.0;
  for (const auto& [a, b, c] : contact.triangles) {
    const Vec3& p = contact.points[a];
    const Vec3& q = contact.points[b];
    const Vec3& r = contact.points[c];
    const double area = (q - p).cross(r - p).norm() / 2.0;
    whole += area;
    if (inside(surface.planar((p + q + r) / 3.0))) covered += area;
  }
  return covered / whole;
}

}  // namespace pneuma
