#include "geometry/self_intersections.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

namespace pneuma {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
using Triangle = std::array<std::uint32_t, 3>;

/// Triangles by place: points at the same place have the same index.
struct Places {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> withArea;  ///< triangles that have some
};

Places placesOf(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto coordinates = [&](std::uint32_t i) {
    const Vec3& p = mesh.points[i];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::ranges::sort(order, {}, coordinates);
  Places places;
  std::vector<std::uint32_t> placeOf(mesh.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vec3& p = mesh.points[order[i]];
    if (i == 0 || p != mesh.points[order[i - 1]]) places.points.emplace_back(p.x(), p.y(), p.z());
    placeOf[order[i]] = static_cast<std::uint32_t>(places.points.size() - 1);
  }
  places.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Triangle t = {placeOf[a], placeOf[b], placeOf[c]};
    if (!CGAL::collinear(places.points[t[0]], places.points[t[1]], places.points[t[2]])) {
      places.withArea.push_back(static_cast<std::uint32_t>(places.triangles.size()));
    }
    places.triangles.push_back(t);
  }
  return places;
}

class PairTest {
 public:
  explicit PairTest(const Places& places) : points_(places.points), triangles_(places.triangles) {}

  bool cut(std::uint32_t s, std::uint32_t t) const {
    Triangle a = triangles_[s];
    Triangle b = triangles_[t];
    // Brings the shared points to the front of both.
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = std::find(b.begin() + shared, b.end(), a[i]);
      if (found == b.end()) continue;
      std::swap(b[shared], *found);
      std::swap(a[shared], a[i]);
      ++shared;
    }
    switch (shared) {
      case 0:
        return apartCut(a, b);
      case 1:
        return hingedCut(a, b);
      case 2:
        return foldedOver(a, b);
      default:
        return false;
    }
  }

 private:
  CGAL::Orientation sideOf(const Triangle& t, std::uint32_t q) const {
    return CGAL::orientation(points_[t[0]], points_[t[1]], points_[t[2]], points_[q]);
  }

  /// All points of `b` from `first` on lie strictly on one side of the plane of `a`.
  bool separates(const Triangle& a, const Triangle& b, std::size_t first) const {
    const CGAL::Orientation side = sideOf(a, b[first]);
    if (side == CGAL::COPLANAR) return false;
    for (std::size_t i = first + 1; i < 3; ++i) {
      if (sideOf(a, b[i]) != side) return false;
    }
    return true;
  }

  Kernel::Triangle_3 triangle(const Triangle& t) const {
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
  }

  bool apartCut(const Triangle& a, const Triangle& b) const {
    return !separates(a, b, 0) && !separates(b, a, 0) &&
           CGAL::do_intersect(triangle(a), triangle(b));
  }

  bool hingedCut(const Triangle& a, const Triangle& b) const {
    if (separates(a, b, 1) || separates(b, a, 1)) return false;
    return CGAL::do_intersect(triangle(a), Kernel::Segment_3(points_[b[1]], points_[b[2]])) ||
           CGAL::do_intersect(triangle(b), Kernel::Segment_3(points_[a[1]], points_[a[2]]));
  }

  bool foldedOver(const Triangle& a, const Triangle& b) const {
    return sideOf(a, b[2]) == CGAL::COPLANAR &&
           CGAL::coplanar_orientation(points_[a[0]], points_[a[1]], points_[a[2]], points_[b[2]]) ==
               CGAL::POSITIVE;
  }

  const std::vector<Point>& points_;
  const std::vector<Triangle>& triangles_;
};

}  // namespace

SelfIntersecting selfIntersecting(const TriangleMesh& mesh, const Progress& progress) {
  constexpr std::size_t PairsBetweenStops = 1 << 14;
  const Places places = placesOf(mesh);
  std::vector<Box> boxes;
  boxes.reserve(places.withArea.size());
  for (const std::uint32_t t : places.withArea) {
    const auto& [a, b, c] = places.triangles[t];
    boxes.emplace_back(places.points[a].bbox() + places.points[b].bbox() + places.points[c].bbox(),
                       t);
  }
  const PairTest test(places);
  SelfIntersecting found;
  std::vector<char> involved(places.triangles.size(), 0);
  std::size_t asked = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (++asked % PairsBetweenStops == 0) progress.throwIfStopped();
    if (!test.cut(a.info(), b.info())) return;
    ++found.pairs;
    involved[a.info()] = involved[b.info()] = 1;
  });
  for (std::size_t t = 0; t < involved.size(); ++t) {
    if (involved[t] != 0) found.triangles.push_back(static_cast<std::uint32_t>(t));
  }
  return found;
}

}  // namespace pneuma
