#include "geometry/nearest_triangle.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

namespace pneuma {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Triangles trianglesOf(const TriangleMesh& mesh) {
  Triangles triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.emplace_back(point(mesh.points[a]), point(mesh.points[b]), point(mesh.points[c]));
  }
  return triangles;
}

}  // namespace

struct NearestTriangle::Tree {
  explicit Tree(const TriangleMesh& mesh)
      : triangles(trianglesOf(mesh)), aabb(triangles.begin(), triangles.end()) {
    // Both are built lazily otherwise, by the first query, which may run beside others.
    aabb.build();
    aabb.accelerate_distance_queries();
  }

  Triangles triangles;
  AabbTree aabb;
};

NearestTriangle::NearestTriangle(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {}

NearestTriangle::~NearestTriangle() = default;

double NearestTriangle::distanceMm(const Vec3& p) const {
  return std::sqrt(tree_->aabb.squared_distance(point(p)));
}

NearestTriangle::Hit NearestTriangle::nearest(const Vec3& p) const {
  const auto [at, triangle] = tree_->aabb.closest_point_and_primitive(point(p));
  return {{at.x(), at.y(), at.z()},
          static_cast<std::size_t>(std::distance(tree_->triangles.cbegin(), triangle))};
}

std::vector<NearestTriangle::LineHit> NearestTriangle::along(const Vec3& p, const Vec3& direction,
                                                             double fromMm, double toMm) const {
  const Kernel::Segment_3 line(point(p + fromMm * direction), point(p + toMm * direction));
  std::vector<Triangles::const_iterator> passed;
  tree_->aabb.all_intersected_primitives(line, std::back_inserter(passed));
  std::vector<LineHit> hits;
  for (const auto& triangle : passed) {
    const Kernel::Vector_3 normal =
        CGAL::cross_product((*triangle)[1] - (*triangle)[0], (*triangle)[2] - (*triangle)[0]);
    const double across = normal * Kernel::Vector_3(direction.x(), direction.y(), direction.z());
    if (across == 0.0) continue;
    hits.push_back({normal * ((*triangle)[0] - point(p)) / across,
                    static_cast<std::size_t>(std::distance(tree_->triangles.cbegin(), triangle))});
  }
  // Ties in the order of triangles, whatever the tree's.
  std::ranges::sort(
      hits, {}, [](const LineHit& hit) { return std::pair(std::abs(hit.alongMm), hit.triangle); });
  return hits;
}

}  // namespace pneuma
