#include "geometry/repair.h"

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
using testing::sphere;
using testing::together;

TEST(Repair, LeavesAHealthySurfaceAsItIs) {
  const TriangleMesh mesh = sphere(50.0);
  const Repaired result = repaired(mesh);
  EXPECT_THAT(result.changes, IsEmpty());
  EXPECT_EQ(result.mesh.points.size(), mesh.points.size());
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
}

TEST(Repair, ClosesAHole) {
  TriangleMesh mesh = sphere(50.0);
  const double whole = examine(mesh).volumeMl;
  mesh.triangles.erase(mesh.triangles.begin() + 200, mesh.triangles.begin() + 204);
  mesh.triangles.erase(mesh.triangles.begin() + 10);
  const Repaired result = repaired(mesh);
  EXPECT_GT(result.before.openEdges, 0U);
  EXPECT_TRUE(result.after.healthy());
  EXPECT_THAT(result.changes, ElementsAre(HasSubstr("Closed 2 holes with 5 triangles")));
  EXPECT_NEAR(result.after.volumeMl, whole, 0.01 * whole);
}

TEST(Repair, TurnsASurfaceOutwards) {
  const Repaired result = repaired(insideOut(sphere(50.0)));
  EXPECT_TRUE(result.after.healthy());
  EXPECT_THAT(result.changes, ElementsAre(HasSubstr("inside-out")));
}

TEST(Repair, TurnsSingleTriangles) {
  TriangleMesh mesh = sphere(50.0);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  std::swap(mesh.triangles[99][0], mesh.triangles[99][1]);
  const Repaired result = repaired(mesh);
  EXPECT_TRUE(result.after.healthy());
  EXPECT_THAT(result.changes, ElementsAre(HasSubstr("Turned 2 triangles")));
}

TEST(Repair, JoinsPointsAtTheSamePlace) {
  TriangleMesh soup;
  for (const auto& triangle : cube(100.0).triangles) {
    for (const auto v : triangle) soup.points.push_back(cube(100.0).points[v]);
    const auto n = static_cast<std::uint32_t>(soup.points.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  const Repaired result = repaired(soup);
  EXPECT_TRUE(result.after.healthy());
  EXPECT_THAT(result.changes, ElementsAre(HasSubstr("Joined 28 points")));
}

TEST(Repair, DropsCopiesFlatTrianglesAndUnusedPoints) {
  TriangleMesh mesh = sphere(50.0);
  const auto [a, b, c] = mesh.triangles[3];
  mesh.triangles.push_back({b, a, c});
  mesh.triangles.push_back({a, a, b});
  mesh.points.emplace_back(1.0, 2.0, 3.0);
  const Repaired result = repaired(mesh);
  EXPECT_TRUE(result.after.healthy());
  EXPECT_THAT(result.changes, ElementsAre("Dropped 1 triangle that named a point twice.",
                                          "Dropped 1 copy of a triangle.",
                                          "Dropped 1 point that no triangle uses."));
}

TEST(Repair, RemovesATriangleWithoutAreaByTurningAnEdge) {
  // The middle of an edge is a point of one of its two triangles only, and a flat one between.
  TriangleMesh mesh = cube(100.0);
  mesh.points.push_back((mesh.points[0] + mesh.points[1]) / 2.0);
  mesh.triangles[4] = {0, 8, 4};
  mesh.triangles.push_back({8, 1, 4});
  mesh.triangles.push_back({0, 1, 8});
  ASSERT_EQ(examine(mesh).degenerateTriangles, 1U);
  ASSERT_TRUE(examine(mesh).closed);
  const Repaired result = repaired(mesh);
  EXPECT_TRUE(result.after.healthy());
  EXPECT_THAT(result.changes, ElementsAre(HasSubstr("Removed 1 triangle without area")));
  EXPECT_DOUBLE_EQ(result.after.volumeMl, 1000.0);
}

TEST(Repair, DropsDebrisAndFins) {
  TriangleMesh mesh = together(sphere(60.0), sphere(2.0, {100.0, 0.0, 0.0}));
  const auto [a, b, c] = mesh.triangles[20];
  mesh.points.push_back(1.5 * mesh.points[a]);
  const auto n = static_cast<std::uint32_t>(mesh.points.size());
  mesh.triangles.push_back({a, b, n - 1});
  const Repaired result = repaired(mesh);
  EXPECT_TRUE(result.after.healthy());
  EXPECT_EQ(result.after.components, 1U);
  EXPECT_NEAR(result.after.volumeMl, examine(sphere(60.0)).volumeMl, 1e-6);
  EXPECT_THAT(result.changes, Contains(HasSubstr("Dropped 2 loose pieces")));
}

TEST(Repair, DropsALargeFinToo) {
  TriangleMesh mesh = cube(100.0);
  mesh.points.emplace_back(-50.0, -50.0, 50.0);
  mesh.triangles.push_back({0, 4, 8});
  const Repaired result = repaired(mesh);
  EXPECT_TRUE(result.after.healthy());
  EXPECT_DOUBLE_EQ(result.after.volumeMl, 1000.0);
  EXPECT_THAT(result.changes, Contains(HasSubstr("next to nothing")));
}

TEST(Repair, RemovesSelfIntersections) {
  TriangleMesh mesh = sphere(50.0, Vec3::Zero(), 4);
  mesh.points[4] = {0.0, 0.0, -70.0};
  const Repaired result = repaired(mesh);
  EXPECT_GT(result.before.selfIntersections, 0U);
  EXPECT_TRUE(result.after.healthy());
  EXPECT_THAT(result.changes, Contains(HasSubstr("cut each other")));
  EXPECT_NEAR(result.after.volumeMl, examine(sphere(50.0)).volumeMl, 0.05 * 523.6);
}

TEST(Repair, RefusesWhatEnclosesNothingAfterwards) {
  TriangleMesh sheet;
  sheet.points = {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_THROW(repaired(sheet), InvalidInput);
  TriangleMesh flat = cube(100.0);
  for (Vec3& p : flat.points) p.z() = 0.0;
  EXPECT_THROW(repaired(flat), InvalidInput);
  EXPECT_THROW(repaired(TriangleMesh()), InvalidInput);
}

TEST(Repair, MendsRealLobes) {
  for (const auto& [name, mesh] : testing::manySurfaces()) {
    const Repaired result = repaired(mesh);
    EXPECT_TRUE(result.after.healthy()) << name;
    EXPECT_NEAR(result.after.volumeMl, result.before.volumeMl, 0.001 * result.before.volumeMl)
        << name;
  }
}

TEST(Repair, StopsWhenAsked) {
  testing::ProgressRecorder stopInTheMiddle(0.4);
  EXPECT_THROW(repaired(sphere(50.0), Progress(stopInTheMiddle)), Cancelled);
}

}  // namespace
}  // namespace pneuma
