#include "geometry/untangling.h"

#include <gtest/gtest.h>

#include "geometry/self_intersections.h"
#include "test_surfaces.h"

namespace pneuma {
namespace {

TEST(Untangling, PartsTrianglesThatCutEachOther) {
  TriangleMesh ball = testing::sphere(50.0, Vec3::Zero(), 4);
  const TriangleMesh before = ball;
  ball.points[100] *= -1.1;  // a spike that leaves the ball on the other side
  const std::size_t pairs = selfIntersecting(ball).pairs;
  ASSERT_GT(pairs, 0U);
  const Untangled result = untangle(ball);
  EXPECT_EQ(result.pairsBefore, pairs);
  EXPECT_EQ(result.pairsAfter, 0U);
  EXPECT_EQ(selfIntersecting(ball).pairs, 0U);
  EXPECT_EQ(ball.triangles, before.triangles);
  EXPECT_NEAR(signedVolumeMm3(ball) / signedVolumeMm3(before), 1.0, 0.01);
  std::size_t moved = 0;
  for (std::size_t p = 0; p < ball.points.size(); ++p) {
    if ((ball.points[p] - before.points[p]).norm() > 1e-9) ++moved;
  }
  EXPECT_LE(moved, result.movedPoints);
  EXPECT_LT(moved, 100U);
}

TEST(Untangling, LeavesSoundSurfacesAlone) {
  TriangleMesh ball = testing::dentedBall(40.0);
  const TriangleMesh before = ball;
  const Untangled result = untangle(ball);
  EXPECT_EQ(result.movedPoints, 0U);
  EXPECT_EQ(ball.points, before.points);
}

TEST(Untangling, GivesUpOnSurfacesThatPassThroughEachOther) {
  TriangleMesh two = testing::together(testing::sphere(30.0, Vec3::Zero(), 6),
                                       testing::sphere(30.0, Vec3(20.0, 0.0, 0.0), 6));
  const TriangleMesh before = two;
  const Untangled result = untangle(two);
  EXPECT_GT(result.pairsAfter, 0U);
  EXPECT_EQ(result.pairsBefore, result.pairsAfter);
  EXPECT_EQ(result.movedPoints, 0U);
  EXPECT_EQ(two.points, before.points);
}

}  // namespace
}  // namespace pneuma
