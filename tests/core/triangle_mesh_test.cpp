#include "core/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

/// The corner of a cube of side `a` at `at`, oriented outwards.
TriangleMesh corner(double a, const Vec3& at) {
  return {{at, at + Vec3(a, 0, 0), at + Vec3(0, a, 0), at + Vec3(0, 0, a)},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST(TriangleMesh, MeasuresOfATetrahedron) {
  const TriangleMesh mesh = corner(6.0, Vec3(-2, 5, 9));
  EXPECT_NEAR(signedVolumeMm3(mesh), 36.0, 1e-12);
  EXPECT_NEAR(areaMm2(mesh), 3 * 18.0 + std::sqrt(3.0) / 4.0 * 72.0, 1e-12);
  EXPECT_EQ(bounds(mesh).min(), Vec3(-2, 5, 9));
  EXPECT_EQ(bounds(mesh).max(), Vec3(4, 11, 15));
}

TEST(TriangleMesh, APartHasThePointsThatItUses) {
  const TriangleMesh mesh = corner(6.0, Vec3::Zero());
  const TriangleMesh part = partOf(mesh, std::span(mesh.triangles).subspan(2, 2));
  ASSERT_EQ(part.points.size(), 4U);
  ASSERT_EQ(part.triangles.size(), 2U);
  for (std::size_t t = 0; t < 2; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(part.points[part.triangles[t][k]], mesh.points[mesh.triangles[t + 2][k]]);
    }
  }
  EXPECT_EQ(partOf(mesh, std::span(mesh.triangles).first(1)).points.size(), 3U);
  EXPECT_TRUE(partOf(mesh, {}).points.empty());
}

TEST(TriangleMesh, VolumeIsNegativeInsideOut) {
  TriangleMesh mesh = corner(6.0, Vec3::Zero());
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(signedVolumeMm3(mesh), -36.0, 1e-12);
}

TEST(TriangleMesh, VolumeDoesNotSufferFarFromTheOrigin) {
  EXPECT_NEAR(signedVolumeMm3(corner(6.0, Vec3::Constant(1e6))), 36.0, 1e-6);
}

TEST(TriangleMesh, OfNothingMeasuresNothing) {
  EXPECT_EQ(signedVolumeMm3({}), 0.0);
  EXPECT_EQ(areaMm2({}), 0.0);
  EXPECT_TRUE(bounds(TriangleMesh{}).isEmpty());
}

}  // namespace
}  // namespace pneuma
