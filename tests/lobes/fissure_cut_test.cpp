#include "lobes/fissure_cut.h"

#include <gtest/gtest.h>

#include "geometry/mesh_topology.h"

namespace pneuma {
namespace {

/// A block with a V-shaped groove from its upper face to `depth` above z = 0, along y.
TriangleMesh groovedBlock(double depth) {
  const std::vector<std::array<double, 2>> profile = {{-30.0, -30.0}, {30.0, -30.0}, {30.0, 30.0},
                                                      {20.0, 30.0},   {0.0, depth},  {-20.0, 30.0},
                                                      {-30.0, 30.0}};
  const std::vector<std::array<std::uint32_t, 3>> face = {
      {0, 1, 4}, {1, 3, 4}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}};
  TriangleMesh mesh;
  for (const double y : {-20.0, 20.0}) {
    for (const auto& [x, z] : profile) mesh.points.emplace_back(x, y, z);
  }
  constexpr std::uint32_t N = 7;
  for (const auto& [a, b, c] : face) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a + N, c + N, b + N});
  }
  for (std::uint32_t i = 0; i < N; ++i) {
    const std::uint32_t next = (i + 1) % N;
    mesh.triangles.push_back({next, i, i + N});
    mesh.triangles.push_back({next, i + N, next + N});
  }
  return mesh;
}

TEST(FissureCut, DoesNotJoinPointsOfTheCapThatAnEdgeOfTheSurfaceJoins) {
  // The cut runs through both ends of the groove's bottom, half a millimetre above it, and nothing
  // but that edge lies between them: a cap that joined them would give it four triangles.
  const TriangleMesh block = groovedBlock(0.5);
  ASSERT_EQ(topology(block).faults(), 0U);
  ASSERT_GT(signedVolumeMm3(block), 0.0);
  RegionComplex complex = complexOf(block, 1);
  const HeightSurface plane;  // z = 0
  const Cut cut = cutRegion(complex, plane,
                            {.region = 1,
                             .below = 1,
                             .above = 2,
                             .snap = 0.1,
                             .capSpacingMm = 500.0,
                             .capPoints = {},
                             .sideOf = {}});
  ASSERT_EQ(cut.outcome, CutOutcome::Done);
  for (const RegionId region : {RegionId{1}, RegionId{2}}) {
    EXPECT_EQ(topology(surfaceOf(complex, region).mesh).faults(), 0U);
  }
  EXPECT_NEAR(volumeMm3(complex, 1) + volumeMm3(complex, 2), signedVolumeMm3(block), 1e-6);
}

}  // namespace
}  // namespace pneuma
