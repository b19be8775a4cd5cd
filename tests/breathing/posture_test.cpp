#include "breathing/posture.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "breathing/breathing_surfaces.h"

namespace pneuma {
namespace {

struct Law {
  Posture posture;
  Side side;
  std::array<double, 4> coefficients;
};

TEST(ForceLaw, IsTheTableOfPostures) {
  for (const Law& law : {Law{Posture::Supine, Side::Right, {0.05, 0.0, 0.9, 0.05}},
                         Law{Posture::Prone, Side::Left, {0.95, 0.0, -0.9, 0.05}},
                         Law{Posture::Upright, Side::Left, {0.05, 0.0, 0.0, 0.95}},
                         Law{Posture::LeftLateral, Side::Right, {0.05, 0.9, 0.0, 0.05}},
                         Law{Posture::LeftLateral, Side::Left, {0.95, -0.9, 0.0, 0.05}},
                         Law{Posture::RightLateral, Side::Right, {0.95, -0.9, 0.0, 0.05}},
                         Law{Posture::RightLateral, Side::Left, {0.05, 0.9, 0.0, 0.05}},
                         Law{Posture::HeadDown, Side::Right, {0.05, 0.0, 0.0, 0.05}}}) {
    const auto found = forceCoefficients(law.side, gravityOf(law.posture));
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(found[k], law.coefficients[k], 1e-15) << static_cast<int>(law.posture) << k;
    }
  }
}

TEST(ForceLaw, IsTheSumOfWhatGravityAddsAtEachWall) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto positive = [](double x) { return std::max(0.0, x); };
  for (int n = 0; n < 50; ++n) {
    const Vec3 g = testing::anyDirection(random);
    const Vec3 q(share(random), share(random), share(random));
    for (const Side side : {Side::Right, Side::Left}) {
      const double out = side == Side::Left ? g.x() : -g.x();
      const double expected =
          0.05 + 0.05 * q.z() +
          0.9 * (positive(-g.y()) * q.y() + positive(g.y()) * (1.0 - q.y()) +
                 positive(g.z()) * q.z() + positive(-out) * q.x() + positive(out) * (1.0 - q.x()));
      EXPECT_NEAR(forceAt(forceCoefficients(side, g), q), expected, 1e-14);
      EXPECT_GE(expected, 0.05);
    }
  }
}

TEST(ForceLaw, AsSphericalHarmonicsIsTheSame) {
  std::mt19937 random(2);
  for (int n = 0; n < 50; ++n) {
    const Vec3 beta = 3.0 * testing::anyDirection(random);
    const Vec3 g = testing::anyDirection(random);
    EXPECT_NEAR(harmonicSum(harmonicsOf(0.3, beta), g), 0.3 + beta.dot(g), 1e-14);
  }
  EXPECT_NEAR(harmonicsOf(0.282094791773878, Vec3::Zero())[0], 1.0, 1e-12);     // Y00
  EXPECT_NEAR(harmonicsOf(0.0, {0.0, 0.488602511902920, 0.0})[1], 1.0, 1e-12);  // Y1-1
}

TEST(MotionDirection, HasTheRatiosOfItsConstants) {
  const Vec3 d = motionDirection({0.5, 0.25, 0.8}, Side::Right, gravityOf(Posture::Supine));
  const Vec3 expected(0.2 * 0.5, 0.4 * 0.25, std::pow(0.8, 1.3));
  EXPECT_TRUE(d.isApprox(expected.normalized(), 1e-14));
  EXPECT_TRUE(motionDirection(Vec3::Zero(), Side::Left, gravityOf(Posture::Supine)).isZero());
  // Outside of the box it is that of the border.
  EXPECT_TRUE(motionDirection({1.2, -0.1, 1.1}, Side::Left, gravityOf(Posture::Supine))
                  .isApprox(Vec3(0.2, 0.0, 1.0).normalized(), 1e-14));
}

TEST(MotionDirection, LeavesTheWallAtRestThatLiesBelow) {
  const auto at = [](const Vec3& q, Side side, Posture posture) {
    return motionDirection(q, side, gravityOf(posture));
  };
  EXPECT_EQ(at({0.5, 0.0, 0.5}, Side::Left, Posture::Supine).y(), 0.0);
  EXPECT_EQ(at({0.5, 1.0, 0.5}, Side::Left, Posture::Prone).y(), 0.0);
  EXPECT_LT(at({0.5, 0.0, 0.5}, Side::Left, Posture::Prone).y(), -0.1);
  EXPECT_EQ(at({1.0, 0.5, 0.5}, Side::Left, Posture::LeftLateral).x(), 0.0);
  EXPECT_LT(at({0.0, 0.5, 0.5}, Side::Left, Posture::LeftLateral).x(), -0.1);
  EXPECT_EQ(at({0.0, 0.5, 0.5}, Side::Right, Posture::LeftLateral).x(), 0.0);
  EXPECT_EQ(at({1.0, 0.5, 0.5}, Side::Right, Posture::RightLateral).x(), 0.0);
  for (const Posture posture : {Posture::Upright, Posture::HeadDown, Posture::LeftLateral}) {
    EXPECT_EQ(at({0.5, 0.0, 0.5}, Side::Right, posture).y(), 0.0);
    EXPECT_EQ(at({0.5, 0.5, 0.0}, Side::Right, posture).z(), 0.0);
  }
}

}  // namespace
}  // namespace pneuma
