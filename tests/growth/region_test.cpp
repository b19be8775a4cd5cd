#include "growth/region.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::ball;

const Wedge Plane{WedgeKind::Plane, {1, 0, 0}, Vec3::UnitX(), Vec3::Zero()};
const Wedge Quarter{WedgeKind::Both, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};

TEST(Wedge, ContainsWhatItsHalfSpacesSay) {
  EXPECT_TRUE(Plane.contains({1.5, 9, 9}));
  EXPECT_FALSE(Plane.contains({0.5, 9, 9}));
  EXPECT_TRUE(Quarter.contains({1, 1, 0}));
  EXPECT_FALSE(Quarter.contains({1, -1, 0}));
  EXPECT_TRUE(Quarter.rest().contains({1, -1, 0}));  // the union of two half-spaces
  EXPECT_TRUE(Quarter.rest().contains({-1, -1, 0}));
  EXPECT_FALSE(Quarter.rest().contains({1, 1, 0}));
}

TEST(Wedge, AndItsRestAreTheWholeSpace) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
    for (const Wedge& wedge : {Plane, Quarter, Quarter.rest()}) {
      EXPECT_NE(wedge.contains(p), wedge.rest().contains(p));
    }
  }
}

TEST(Wedge, IsLeftWhereTheRayMeetsItsPlane) {
  EXPECT_DOUBLE_EQ(Plane.exitDistance({3, 0, 0}, -Vec3::UnitX()), 2.0);
  EXPECT_DOUBLE_EQ(Plane.exitDistance({0, 0, 0}, Vec3::UnitX()), 0.0);  // starts outside
  EXPECT_TRUE(std::isinf(Plane.exitDistance({3, 0, 0}, Vec3::UnitX())));
}

TEST(Wedge, ARayFromItsOwnEdgeIntoItIsNotLeftAtOnce) {
  // The branching point lies on the planes that were laid through it.
  EXPECT_TRUE(std::isinf(Quarter.exitDistance(Vec3::Zero(), Vec3(1, 1, 0).normalized())));
  EXPECT_DOUBLE_EQ(Quarter.exitDistance(Vec3::Zero(), -Vec3::UnitX()), 0.0);
}

TEST(Wedge, AUnionIsLeftWhereBothHalfSpacesAre) {
  // x <= 0 or y <= 0, from (-1, 2, 0) along x: left at x = 0, where y > 0.
  const Wedge either = Quarter.rest();
  EXPECT_DOUBLE_EQ(either.exitDistance({-1, 2, 0}, Vec3::UnitX()), 1.0);
  // Along the diagonal downwards y <= 0 is entered before x <= 0 is left.
  const Vec3 down = Vec3(1, -1, 0).normalized();
  EXPECT_TRUE(std::isinf(either.exitDistance({-3, 2, 0}, down)));
}

TEST(Region, IsTheOrganWithinItsWalls) {
  const auto organ = ball(10.0);
  Region region;
  region.organ = organ.get();
  region.box = organ->bounds();
  region.walls = {Plane};
  EXPECT_TRUE(region.contains({5, 0, 0}));
  EXPECT_FALSE(region.contains({-5, 0, 0}));
  EXPECT_FALSE(region.contains({11, 0, 0}));
  EXPECT_NEAR(region.exitDistance({5, 0, 0}, Vec3::UnitX()), 5.0, 2e-3);
  EXPECT_NEAR(region.exitDistance({5, 0, 0}, -Vec3::UnitX()), 4.0, 2e-3);
}

}  // namespace
}  // namespace pneuma
