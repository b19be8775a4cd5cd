#include "anatomy/thorax.h"

#include <gtest/gtest.h>

#include "anatomy/efficiency.h"
#include "core/random.h"
#include "core/units.h"
#include "support/domain_checks.h"

namespace pneuma {
namespace {

TEST(Thorax, HoldsThePapersVolume) {
  const double millilitresInside = millilitres(testing::latticeVolumeMm3(Thorax(), 1.5));
  EXPECT_NEAR(millilitresInside, 6388.0, 0.01 * 6388.0);  // Kitaoka 1999
  EXPECT_NEAR(millilitresInside, Thorax::VolumeMl, 0.002 * Thorax::VolumeMl);
}

TEST(Thorax, GivesTheRightLungMore) {
  const Thorax thorax;
  Random random(1);
  int right = 0;
  int all = 0;
  for (int i = 0; i < 200000; ++i) {
    const Vec3 p = testing::randomPoint(random, thorax.bounds());
    if (!thorax.contains(p)) continue;
    ++all;
    right += p.x() < 0.0 ? 1 : 0;  // LPS: the patient's right
  }
  EXPECT_NEAR(static_cast<double>(right) / all, 0.5245, 0.006);
}

TEST(Thorax, LeavesOutEveryOrganBesideTheLungs) {
  const Thorax thorax;
  const Vec3 rightLung(-70.0, 0.0, -150.0);
  const Vec3 leftLung(85.0, 20.0, -150.0);
  const Vec3 gutter(-45.0, 85.0, -270.0);  // beside the vertebral column
  EXPECT_TRUE(thorax.contains(rightLung));
  EXPECT_TRUE(thorax.contains(leftLung));
  EXPECT_TRUE(thorax.contains(gutter));
  EXPECT_FALSE(thorax.contains({-70.0, 0.0, -270.0})) << "abdomen";
  EXPECT_FALSE(thorax.contains({-10.0, 0.0, -150.0})) << "mediastinum";
  EXPECT_FALSE(thorax.contains({-20.0, 55.0, -200.0})) << "vertebra";
  EXPECT_FALSE(thorax.contains({40.0, -40.0, -205.0})) << "heart";
  EXPECT_TRUE(thorax.contains({-60.0, -40.0, -205.0})) << "the heart lies on the left";
  EXPECT_FALSE(thorax.contains({30.0, 30.0, -120.0})) << "aorta";
  EXPECT_TRUE(thorax.contains({30.0, 30.0, -60.0})) << "above the descending aorta";
  EXPECT_FALSE(thorax.contains({-149.0, 0.0, -200.0})) << "ribs";
}

TEST(Thorax, FallsIntoThe181CubesOfThePaper) {
  const Thorax thorax;
  const EfficiencyCubes cubes = thoraxCubes();
  const auto samplesInside = [&](const Vec3& corner) {
    int inside = 0;
    for (int i = 0; i < 216; ++i) {
      const Vec3 offset(i % 6 + 0.5, i / 6 % 6 + 0.5, i / 36 + 0.5);
      inside += thorax.contains(corner + offset * (cubes.edgeMm / 6.0)) ? 1 : 0;
    }
    return inside;
  };
  int taken = 0;
  int whole = 0;
  for (int x = -6; x < 6; ++x)
    for (int y = -4; y < 4; ++y)
      for (int z = -10; z < 0; ++z) {
        const int inside = samplesInside(cubes.node + cubes.edgeMm * Vec3(x, y, z));
        taken += inside >= cubes.leastInside * 216 ? 1 : 0;
        whole += inside == 216 ? 1 : 0;
      }
  EXPECT_EQ(taken, 181);
  EXPECT_EQ(whole, 93);
}

TEST(Thorax, LetsWaysGraze) {
  const Thorax thorax;
  // Straight down in a gutter, along a wall that never comes nearer: to the diaphragm.
  const double down = thorax.exitDistance({-49.999, 80.0, -170.0}, -Vec3::UnitZ(), 500.0);
  const double s = 49.999 * 49.999 / 22500.0 + 0.64;
  EXPECT_NEAR(170.0 + down, 252.2 + 47.8 * s, 1e-6);
  // From a point on the mediastinum away from it, and into it.
  EXPECT_NEAR(thorax.exitDistance({-15.0, 0.0, -150.0}, Vec3::UnitX(), 500.0), 0.0, 1e-9);
  EXPECT_GT(thorax.exitDistance({-15.0, 0.0, -150.0}, -Vec3::UnitX(), 500.0), 100.0);
}

}  // namespace
}  // namespace pneuma
