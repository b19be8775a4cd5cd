#include "core/math.h"

#include <numbers>

#include <gtest/gtest.h>

#include "core/units.h"

namespace pneuma {
namespace {

TEST(AngleBetween, IsExactAlsoForSmallAndStraightAngles) {
  EXPECT_DOUBLE_EQ(angleBetween(Vec3(1, 0, 0), Vec3(0, 5, 0)), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(angleBetween(Vec3(1, 0, 0), Vec3(-3, 0, 0)), std::numbers::pi);
  EXPECT_EQ(angleBetween(Vec3(1, 1, 1), Vec3(2, 2, 2)), 0.0);
  EXPECT_NEAR(angleBetween(Vec3(1, 0, 0), Vec3(1, 1e-9, 0)), 1e-9, 1e-20);
  EXPECT_EQ(angleBetween(Vec3::Zero(), Vec3(1, 0, 0)), 0.0);
}

TEST(Rotated, TurnsCounterClockwiseAboutTheAxis) {
  const Vec3 turned = rotated(Vec3(2, 0, 1), Vec3::UnitZ(), std::numbers::pi / 2);
  EXPECT_TRUE(turned.isApprox(Vec3(0, 2, 1)));
}

TEST(AnyPerpendicular, IsAUnitVectorAcross) {
  for (const Vec3& d : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0, -0.8)}) {
    EXPECT_NEAR(anyPerpendicular(d).norm(), 1.0, 1e-12);
    EXPECT_NEAR(anyPerpendicular(d).dot(d), 0.0, 1e-12);
  }
}

TEST(Units, ConvertThereAndBack) {
  EXPECT_EQ(millilitres(3.5e6), 3500.0);
  EXPECT_EQ(cubicMillimetres(1.5), 1500.0);
  EXPECT_DOUBLE_EQ(degrees(std::numbers::pi), 180.0);
  EXPECT_DOUBLE_EQ(radians(90.0), std::numbers::pi / 2);
}

}  // namespace
}  // namespace pneuma
