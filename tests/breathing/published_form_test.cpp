#include "breathing/published_form.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

TEST(PublishedForm, TurnsWithPowersOfTheShares) {
  const PublishedForm form{{0.5, 2.0, 1.0}, {1.0, 2.0, 3.0}, 0.1, {0.2, 0.3, 0.4}};
  const Vec3 share(0.8, 0.5, 0.9);
  const Vec3 d(0.5 * 0.8, 2.0 * 0.5 * 0.5, std::pow(0.9, 3.0));
  EXPECT_TRUE(form.direction(share).isApprox(d / d.norm(), 1e-12));
  EXPECT_NEAR(form.force(share), 0.1 + 0.16 + 0.15 + 0.36, 1e-12);
}

TEST(PublishedForm, StandsStillWhereEveryDirectionEnds) {
  const PublishedForm cubes{Vec3::Ones(), Vec3::Constant(3.0), 1.0, Vec3::Zero()};
  EXPECT_TRUE(cubes.direction(Vec3::Zero()).isZero());
  EXPECT_TRUE(cubes.direction({-1.0, -2.0, 0.0}).isZero());
  // Beyond the box as at its wall.
  EXPECT_TRUE(reasonedForm()
                  .direction({2.0, 3.0, 4.0})
                  .isApprox(reasonedForm().direction(Vec3::Ones()), 1e-12));
}

TEST(PublishedField, TakesTheTablesConstantsInBothLungs) {
  const Box3 box(Vec3(0.0, 0.0, 0.0), Vec3(100.0, 150.0, 200.0));
  // At the base, front and side: q = (1, 1, 1).
  const Vec3 d = Vec3(0.15, 1.25, 1.0).normalized();
  const double length = 200.0 * 0.1 * (-0.25 + 0.51 + 0.23 + 1.07);
  const PublishedForm& deep = publishedForm(MotionPreset::Deep);
  EXPECT_TRUE(PublishedField(deep, {Side::Left, box}, 0.1)
                  .at({100.0, 0.0, 0.0})
                  .isApprox(length * Vec3(d.x(), -d.y(), -d.z()), 1e-12));
  EXPECT_TRUE(PublishedField(deep, {Side::Right, box}, 0.1)
                  .at({0.0, 0.0, 0.0})
                  .isApprox(length * -d, 1e-12));
  EXPECT_NEAR(publishedForm(MotionPreset::Quiet).force(Vec3::Ones()), 1.19, 1e-12);
}

}  // namespace
}  // namespace pneuma
