// What CGAL says of the same surfaces, by other ways.

#include <array>
#include <iterator>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/self_intersections.h"
#include "geometry/surface_domain.h"
#include "geometry/test_surfaces.h"

namespace pneuma {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Kernel::Point_3 point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Mesh cgalMesh(const TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const Vec3& p : mesh.points) points.push_back(point(p));
  for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({a, b, c});
  Mesh result;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, result);
  return result;
}

Vec3 randomInUnitBox(Random& random) {
  const double x = random.uniform();
  const double y = random.uniform();
  const double z = random.uniform();
  return {x, y, z};
}

TEST(CgalAgreement, InsideAndOutside) {
  for (const auto& [name, surface] : testing::manySurfaces()) {
    const SurfaceDomain domain(surface);
    const Mesh mesh = cgalMesh(surface);
    const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(mesh);
    Random random(7);
    int differ = 0;
    const auto compare = [&](const Vec3& p) {
      differ += domain.contains(p) != (side(point(p)) == CGAL::ON_BOUNDED_SIDE) ? 1 : 0;
    };
    const Box3 box = domain.bounds();
    for (int i = 0; i < 20000; ++i) {
      compare(box.min() + box.sizes().cwiseProduct(randomInUnitBox(random)));
    }
    for (const double distance : {1e-3, 1e-9}) {
      for (int i = 0; i < 5000; ++i) {
        const auto& [a, b, c] = surface.triangles[random.below(surface.triangles.size())];
        const double u = random.uniform();
        const double v = random.uniform() * (1.0 - u);
        const Vec3 onWall =
            u * surface.points[a] + v * surface.points[b] + (1.0 - u - v) * surface.points[c];
        compare(onWall + distance * (2.0 * randomInUnitBox(random) - Vec3::Ones()));
      }
    }
    EXPECT_EQ(differ, 0) << name;
  }
}

TEST(CgalAgreement, SelfIntersections) {
  auto surfaces = testing::manySurfaces();
  surfaces.push_back({"balls through one another",
                      testing::together(testing::sphere(50.0), testing::sphere(40.0, {30, 9, 4}))});
  TriangleMesh crumpled = testing::sphere(50.0);
  Random random(3);
  for (Vec3& p : crumpled.points) p += 6.0 * (randomInUnitBox(random) - Vec3::Constant(0.5));
  surfaces.push_back({"crumpled ball", crumpled});
  for (const auto& [name, surface] : surfaces) {
    const Mesh mesh = cgalMesh(surface);
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    PMP::self_intersections(mesh, std::back_inserter(pairs));
    EXPECT_EQ(selfIntersecting(surface).pairs, pairs.size()) << name;
  }
}

}  // namespace
}  // namespace pneuma
