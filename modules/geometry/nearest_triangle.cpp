#include "geometry/nearest_triangle.h"

#include <cmath>
#include <vector>

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

}  // namespace pneuma
