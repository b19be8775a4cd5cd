#include "geometry/mesh_doctor.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/test_surfaces.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using ::testing::Contains;
using testing::cube;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::insideOut;
using ::testing::IsEmpty;
using testing::scaled;
using testing::sphere;
using testing::together;

TEST(MeshDoctor, FindsACubeHealthyAndMeasuresItExactly) {
  const MeshReport report = examine(cube(100.0));
  EXPECT_TRUE(report.healthy());
  EXPECT_EQ(report.points, 8U);
  EXPECT_EQ(report.triangles, 12U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_TRUE(report.selfIntersectionsCounted);
  EXPECT_DOUBLE_EQ(report.volumeMl, 1000.0);
  EXPECT_DOUBLE_EQ(report.areaMm2, 60000.0);
  EXPECT_EQ(report.unitsGuess, "mm");
  EXPECT_THAT(complaints(report), IsEmpty());
}

TEST(MeshDoctor, CountsTheOpenEdgesOfAMissingTriangle) {
  TriangleMesh mesh = sphere(50.0);
  mesh.triangles.pop_back();
  const MeshReport report = examine(mesh);
  EXPECT_EQ(report.openEdges, 3U);
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.orientedOutwards);
  EXPECT_EQ(report.volumeMl, 0.0);
  EXPECT_FALSE(report.healthy());
  EXPECT_THAT(complaints(report),
              ElementsAre("The surface has 3 open edges, so that it encloses nothing; run `pneuma "
                          "repair` to close its holes."));
}

TEST(MeshDoctor, TellsASurfaceThatIsInsideOut) {
  const MeshReport report = examine(insideOut(sphere(50.0)));
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.orientedOutwards);
  EXPECT_THAT(complaints(report), ElementsAre(HasSubstr("inside-out")));
}

TEST(MeshDoctor, CountsTheEdgesOfATriangleTurnedRound) {
  TriangleMesh mesh = sphere(50.0);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  const MeshReport report = examine(mesh);
  EXPECT_EQ(report.misorientedEdges, 3U);
  EXPECT_FALSE(report.orientedOutwards);
}

TEST(MeshDoctor, CountsTrianglesGivenTwiceHoweverTurned) {
  TriangleMesh mesh = sphere(50.0);
  const auto [a, b, c] = mesh.triangles[3];
  mesh.triangles.push_back({c, a, b});
  mesh.triangles.push_back({b, a, c});
  const MeshReport report = examine(mesh);
  EXPECT_EQ(report.duplicateTriangles, 2U);
  EXPECT_EQ(report.nonManifoldEdges, 3U);
  EXPECT_FALSE(report.healthy());
}

TEST(MeshDoctor, CountsTrianglesWithoutArea) {
  TriangleMesh mesh = sphere(50.0);
  const auto a = mesh.triangles[0][0];
  const auto b = mesh.triangles[0][1];
  mesh.triangles.push_back({a, a, b});  // takes no part in the edges
  mesh.points.push_back((mesh.points[a] + mesh.points[b]) / 2.0);
  mesh.triangles.push_back({a, b, static_cast<std::uint32_t>(mesh.points.size() - 1)});
  const MeshReport report = examine(mesh);
  EXPECT_EQ(report.degenerateTriangles, 2U);
  EXPECT_EQ(report.openEdges, 2U);
}

TEST(MeshDoctor, CountsAFinAsANonManifoldEdge) {
  TriangleMesh mesh = cube(100.0);
  mesh.points.emplace_back(-50.0, -50.0, 50.0);
  mesh.triangles.push_back({0, 4, 8});
  const MeshReport report = examine(mesh);
  EXPECT_EQ(report.nonManifoldEdges, 1U);
  EXPECT_EQ(report.openEdges, 2U);
  EXPECT_FALSE(report.manifold);
}

TEST(MeshDoctor, CountsAPointWhereTwoBodiesTouch) {
  // The second cube's corner 0 is the first one's corner 7.
  TriangleMesh mesh = together(cube(100.0), cube(100.0, Vec3::Constant(100.0)));
  for (auto& triangle : mesh.triangles) {
    for (auto& v : triangle) v = v == 8 ? 7 : v;
  }
  const MeshReport report = examine(mesh);
  EXPECT_EQ(report.components, 2U);
  EXPECT_EQ(report.nonManifoldVertices, 1U);
  EXPECT_EQ(report.nonManifoldEdges, 0U);
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.manifold);
  EXPECT_EQ(report.selfIntersections, 0U) << "points at the same place are shared";
}

TEST(MeshDoctor, KnowsACavityFromABodyInABody) {
  EXPECT_TRUE(examine(together(sphere(60.0), insideOut(sphere(20.0)))).healthy());
  EXPECT_FALSE(examine(together(sphere(60.0), sphere(20.0))).orientedOutwards);
  const Vec3 aside(150.0, 0.0, 0.0);
  EXPECT_TRUE(examine(together(sphere(60.0), sphere(20.0, aside))).healthy());
  EXPECT_FALSE(examine(together(sphere(60.0), insideOut(sphere(20.0, aside)))).orientedOutwards);
}

TEST(MeshDoctor, CountsPairsOfTrianglesThatCutEachOther) {
  TriangleMesh pierced = sphere(50.0);
  pierced.points[4] = {0.0, 0.0, -90.0};
  const MeshReport report = examine(pierced);
  EXPECT_GE(report.selfIntersections, 4U);
  EXPECT_FALSE(report.fitToGrow());
  EXPECT_THAT(complaints(report), Contains(HasSubstr("cut each other")));
  EXPECT_FALSE(examine(pierced, SelfIntersections::Skip).selfIntersectionsCounted);
}

TEST(MeshDoctor, CountsATriangleFoldedOverItsNeighbourOnce) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {100, 0, 0}, {40, 80, 0}, {50, 60, 0}, {50, -60, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(examine(mesh).selfIntersections, 1U);
  mesh.triangles = {{0, 1, 2}, {1, 0, 4}};
  EXPECT_EQ(examine(mesh).selfIntersections, 0U);
}

TEST(MeshDoctor, CountsATriangleThatTouchesAnotherWithACorner) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {20, 20, 0}, {30, 20, 50}, {20, 30, 60}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(examine(mesh).selfIntersections, 1U);
  mesh.points[3].z() = 1e-12;
  EXPECT_EQ(examine(mesh).selfIntersections, 0U);
}

TEST(MeshDoctor, GrowsInASurfaceWithAFewSelfIntersectionsOnly) {
  MeshReport report = examine(sphere(50.0));
  ASSERT_EQ(report.triangles, 512U);
  report.selfIntersections = 2;
  EXPECT_TRUE(report.fitToGrow());
  EXPECT_FALSE(report.healthy());
  report.selfIntersections = 3;
  EXPECT_FALSE(report.fitToGrow());
}

TEST(MeshDoctor, GuessesUnitsFromTheSizeOfALung) {
  const TriangleMesh lobe = cube(150.0);
  EXPECT_EQ(examine(lobe).unitsGuess, "mm");
  EXPECT_EQ(examine(scaled(lobe, 0.1)).unitsGuess, "cm");
  EXPECT_EQ(examine(scaled(lobe, 0.001)).unitsGuess, "m");
  EXPECT_EQ(examine(scaled(lobe, 100.0)).unitsGuess, "unknown");
  EXPECT_THAT(complaints(examine(scaled(lobe, 0.001))), ElementsAre(HasSubstr("metres")));
}

TEST(MeshDoctor, RefusesWhatIsNoMesh) {
  TriangleMesh mesh = cube(100.0);
  mesh.points[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(examine(mesh), InvalidInput);
  mesh = cube(100.0);
  mesh.triangles[2][1] = 8;
  EXPECT_THROW(examine(mesh), InvalidInput);
}

TEST(MeshDoctor, CallsAnEmptySurfaceEmpty) {
  const MeshReport report = examine(TriangleMesh());
  EXPECT_FALSE(report.healthy());
  EXPECT_THAT(complaints(report), ElementsAre(HasSubstr("no triangles")));
}

TEST(MeshDoctor, StopsWhenAsked) {
  testing::ProgressRecorder stopAtOnce(0.0);
  EXPECT_THROW(examine(sphere(50.0), SelfIntersections::Ask, Progress(stopAtOnce)), Cancelled);
}

}  // namespace
}  // namespace pneuma
