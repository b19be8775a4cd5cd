#include "anatomy/organ.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/validation.h"
#include "core/error.h"
#include "core/units.h"

namespace pneuma {
namespace {

TEST(Organ, SimpleOneHasThePapersTrunk) {
  const Organ organ = simpleOrgan();
  ASSERT_EQ(organ.central.size(), 1U);
  const Branch& trunk = organ.central[0];
  EXPECT_EQ(trunk.parent, -1);
  EXPECT_EQ(trunk.proximal, Vec3::Zero());
  EXPECT_NEAR((trunk.distal - Vec3(0.0, 0.0, -75.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(2.0 * trunk.radiusMm, 18.0, 1e-9);
  EXPECT_EQ(trunk.origin, Origin::Template);
}

TEST(Organ, AllShapesHaveTheVolumeAskedForAndATrunkInside) {
  for (const double volumeMl : {1.0, 500.0, 9424.8, 1e5}) {
    for (const Organ& organ : {simpleOrgan(volumeMl), sphereOrgan(volumeMl),
                               cylinderOrgan(volumeMl), cubeOrgan(volumeMl)}) {
      EXPECT_NEAR(millilitres(organ.region.domain->volumeMm3()), volumeMl, 1e-6 * volumeMl);
      EXPECT_THAT(problems(organ.central), ::testing::IsEmpty());
      const Branch& trunk = organ.central[0];
      EXPECT_TRUE(organ.region.domain->containsSegment(trunk.proximal, trunk.distal));
      EXPECT_NEAR(-4.0 * trunk.distal.z(), organ.region.domain->bounds().sizes().z(), 1e-6);
      EXPECT_NEAR(2.0 * trunk.radiusMm, 18.0 * std::cbrt(volumeMl / SimpleOrgan::VolumeMl), 1e-6);
    }
    EXPECT_NEAR(millilitres(thoraxRegion(volumeMl).domain->volumeMm3()), volumeMl, 1e-6 * volumeMl);
  }
}

TEST(Organ, CylinderIsThreeRadiiHigh) {
  const Vec3 sizes = cylinderOrgan().region.domain->bounds().sizes();
  EXPECT_NEAR(sizes.x(), 200.0, 1e-6);
  EXPECT_NEAR(sizes.z(), 300.0, 1e-6);
}

TEST(Organ, RefusesVolumesThatCannotBe) {
  for (const double volumeMl : {0.0, -5.0, 0.5, 1e6, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(simpleOrgan(volumeMl), InvalidInput) << volumeMl;
    EXPECT_THROW(sphereOrgan(volumeMl), InvalidInput) << volumeMl;
    EXPECT_THROW(cylinderOrgan(volumeMl), InvalidInput) << volumeMl;
    EXPECT_THROW(cubeOrgan(volumeMl), InvalidInput) << volumeMl;
    EXPECT_THROW(thoraxRegion(volumeMl), InvalidInput) << volumeMl;
  }
}

}  // namespace
}  // namespace pneuma
