#include "core/scaled_domain.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

/// A ball of 10 mm about (5, 0, 0), twice as large about the origin: 20 mm about (10, 0, 0).
const ScaledDomain Twice(testing::ball(10.0, {5, 0, 0}), Vec3::Zero(), 2.0);

TEST(ScaledDomain, AnswersAsTheLargerRegionWould) {
  EXPECT_TRUE(Twice.contains({29.9, 0, 0}));
  EXPECT_FALSE(Twice.contains({30.1, 0, 0}));
  EXPECT_TRUE(Twice.containsSegment({-9.9, 0, 0}, {29.9, 0, 0}));
  EXPECT_FALSE(Twice.containsSegment({0, 0, 0}, {30.5, 0, 0}));
  EXPECT_NEAR(Twice.distanceToWall({15, 0, 0}), 15.0, 1e-12);
  EXPECT_NEAR(Twice.exitDistance({10, 0, 0}, Vec3::UnitY(), 100.0), 20.0, 0.005);
  EXPECT_EQ(Twice.exitDistance({10, 0, 0}, Vec3::UnitY(), 7.0), 7.0);
  EXPECT_NEAR(Twice.volumeMm3(), testing::ball(20.0)->volumeMm3(), 1e-9);
  EXPECT_TRUE(Twice.bounds().isApprox(Box3(Vec3(-10, -20, -20), Vec3(30, 20, 20))));
}

TEST(ScaledDomain, AnswersWholeRows) {
  // Points at -12, -4, 4 ... 36: inside from -10 to 30; the second is not asked for.
  EXPECT_EQ(Twice.insideAlongX({-12, 0, 0}, 8.0, 0b1111101), 0b0111100U);
}

TEST(ScaledDomain, RefusesAFactorThatLeavesNothing) {
  EXPECT_THROW(ScaledDomain(testing::ball(1.0), Vec3::Zero(), 0.0), InvalidInput);
  EXPECT_THROW(ScaledDomain(testing::ball(1.0), Vec3::Zero(), -1.0), InvalidInput);
}

}  // namespace
}  // namespace pneuma
