#include "core/grid_domain.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

Vec3 randomPoint(Random& random, double reach) {
  const double x = random.uniform(-reach, reach);
  const double y = random.uniform(-reach, reach);
  return {x, y, random.uniform(-reach, reach)};
}

TEST(GridDomain, AnswersAsTheDomainItself) {
  const auto ball = testing::ball(20.0, Vec3(1, 2, 3));
  const GridDomain grid(ball, 1.5);
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = randomPoint(random, 26.0);
    EXPECT_EQ(grid.contains(p), ball->contains(p));
  }
  EXPECT_EQ(grid.volumeMm3(), ball->volumeMm3());
  EXPECT_EQ(grid.bounds().min(), ball->bounds().min());
}

TEST(GridDomain, IsExactAtTheWall) {
  const auto ball = testing::ball(20.0);
  const GridDomain grid(ball, 2.0);
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 way = randomPoint(random, 1.0).normalized();
    EXPECT_TRUE(grid.contains(way * (20.0 - 1e-9)));
    EXPECT_FALSE(grid.contains(way * (20.0 + 1e-9)));
  }
}

class CountingBall : public testing::BallDomain {
 public:
  CountingBall() : BallDomain(40.0) {}

  bool contains(const Vec3& p) const override {
    ++calls;
    return BallDomain::contains(p);
  }

  mutable std::atomic<int> calls = 0;
};

TEST(GridDomain, AsksTheDomainNearTheWallOnly) {
  const auto ball = std::make_shared<CountingBall>();
  const GridDomain grid(ball, 1.0);
  ball->calls = 0;
  Random random(3);
  for (int i = 0; i < 1000; ++i) grid.contains(randomPoint(random, 15.0));
  EXPECT_EQ(ball->calls, 0);
  grid.contains(Vec3(40, 0, 0));
  EXPECT_EQ(ball->calls, 1);
}

TEST(GridDomain, JudgesSegmentsAsTheDomainItself) {
  const auto ball = testing::ball(20.0);
  const GridDomain grid(ball, 1.5);
  Random random(4);
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a = randomPoint(random, 15.0);
    const Vec3 b = randomPoint(random, 15.0);
    // A ball is convex: a segment lies inside if both ends do.
    const bool expected = ball->contains(a) && ball->contains(b);
    inside += expected ? 1 : 0;
    EXPECT_EQ(grid.containsSegment(a, b), expected);
  }
  EXPECT_GT(inside, 100);
  EXPECT_LT(inside, 2900);
}

/// A ball with a ball taken out of its middle.
class Shell : public testing::BallDomain {
 public:
  Shell() : BallDomain(30.0) {}

  bool contains(const Vec3& p) const override { return BallDomain::contains(p) && p.norm() > 8.0; }

  double distanceToWall(const Vec3& p) const override {
    return std::min(BallDomain::distanceToWall(p), std::abs(p.norm() - 8.0));
  }
};

TEST(GridDomain, NoticesASegmentThroughAHollow) {
  const GridDomain grid(std::make_shared<Shell>(), 1.0);
  EXPECT_FALSE(grid.containsSegment(Vec3(-20, 0, 0), Vec3(20, 0, 0)));
  EXPECT_FALSE(grid.containsSegment(Vec3(-20, 7, 0), Vec3(20, 7, 0)));
  EXPECT_TRUE(grid.containsSegment(Vec3(-20, 9, 0), Vec3(20, 9, 0)));
}

TEST(GridDomain, DistanceIsALowerBound) {
  const Shell shell;
  const GridDomain grid(std::make_shared<Shell>(), 1.0);
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = randomPoint(random, 30.0);
    EXPECT_LE(grid.distanceToWall(p), shell.distanceToWall(p) + 1e-12);
  }
}

}  // namespace
}  // namespace pneuma
