#include "anatomy/right_lung.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/branch_order.h"
#include "anatomy/validation.h"
#include "core/error.h"
#include "core/random.h"
#include "core/units.h"

namespace pneuma {
namespace {

const RightLung& lung() {
  static const RightLung instance = rightLung();
  return instance;
}

/// Volumes of the lobes by drawing random points, ml.
std::array<double, 3> sampledVolumesMl(const RightLung& organ) {
  const Box3 box = organ.lobes[0].domain->bounds();
  Random random(1);
  constexpr int Draws = 200000;
  std::array<double, 3> inside{};
  for (int i = 0; i < Draws; ++i) {
    const double x = random.uniform(box.min().x(), box.max().x());
    const double y = random.uniform(box.min().y(), box.max().y());
    const Vec3 p(x, y, random.uniform(box.min().z(), box.max().z()));
    for (std::size_t k = 0; k < 3; ++k) inside[k] += organ.lobes[k].domain->contains(p) ? 1 : 0;
  }
  for (double& count : inside) count *= millilitres(box.volume()) / Draws;
  return inside;
}

TEST(RightLung, HasTheVolumesAskedFor) {
  const auto volume = sampledVolumesMl(lung());
  // Five standard deviations of the sampling: about 1 % of the lung.
  EXPECT_NEAR(volume[0] + volume[1] + volume[2], 3500.0, 35.0);
  EXPECT_NEAR(volume[0], 0.36 * 3500.0, 30.0);
  EXPECT_NEAR(volume[1], 0.18 * 3500.0, 25.0);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(millilitres(lung().lobes[k].domain->volumeMm3()), volume[k], 30.0);
  }
}

TEST(RightLung, FollowsOtherVolumesAndFractions) {
  const RightLung small = rightLung(1750.0, 0.30, 0.25);
  const auto volume = sampledVolumesMl(small);
  EXPECT_NEAR(volume[0] + volume[1] + volume[2], 1750.0, 20.0);
  EXPECT_NEAR(volume[0] / 1750.0, 0.30, 0.01);
  EXPECT_NEAR(volume[1] / 1750.0, 0.25, 0.01);
}

TEST(RightLung, LiesOnThePatientsRightInLps) {
  for (const LobeRegion& region : lung().lobes) EXPECT_LT(region.domain->bounds().max().x(), 0.0);
}

TEST(RightLung, AirwaysAreHuangsAndEndInTheirLobes) {
  const AirwayTree& airways = lung().central;
  EXPECT_THAT(problems(airways), ::testing::IsEmpty());
  ASSERT_EQ(airways.size(), 6U);
  EXPECT_THAT(generations(airways), ::testing::ElementsAre(0, 1, 2, 2, 3, 3));
  const std::array<double, 6> lengths = {142.0, 24.4, 16.9, 29.8, 18.0, 26.7};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(lengthMm(airways[i]), lengths[i], 1e-9);
  const Children children(airways);
  std::size_t ends = 0;
  for (std::size_t i = 0; i < airways.size(); ++i) {
    if (!children.isTerminal(i)) continue;
    ++ends;
    for (const LobeRegion& region : lung().lobes) {
      EXPECT_EQ(region.domain->contains(airways[i].distal), region.lobe == airways[i].lobe);
    }
  }
  EXPECT_EQ(ends, 3U);
}

TEST(RightLung, RefusesWhatCannotBe) {
  EXPECT_THROW(rightLung(0.0), InvalidInput);
  EXPECT_THROW(rightLung(1e9), InvalidInput);
  EXPECT_THROW(rightLung(3500.0, 0.6, 0.4), InvalidInput);
  EXPECT_THROW(rightLung(3500.0, -0.1, 0.4), InvalidInput);
}

}  // namespace
}  // namespace pneuma
