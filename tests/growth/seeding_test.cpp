#include "growth/seeding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::ball;
using testing::box;

TEST(Seeding, ALatticeHoldsAsManyPointsAsItsSpacingSays) {
  const std::vector<LobeRegion> lobes = {{Lobe::Whole, ball(50.0)}};
  const SeedPoints seeds = seedLattice(lobes, 2.0, 0.0, 1);
  EXPECT_NEAR(static_cast<double>(seeds.count()), lobes[0].domain->volumeMm3() / 8.0,
              0.005 * 65450);
  for (const Vec3& p : seeds.byRegion[0]) {
    ASSERT_TRUE(lobes[0].domain->contains(p));
    const Vec3 steps = (p - seeds.anchor) / 2.0;
    ASSERT_NEAR((steps - Vec3(steps.array().round())).norm(), 0.0, 1e-9);
  }
}

TEST(Seeding, LobesShareOneLattice) {
  const std::vector<LobeRegion> lobes = {{Lobe::RightUpper, box({0, 0, 0}, {40, 40, 40})},
                                         {Lobe::RightLower, box({0, 0, -40}, {40, 40, 0})}};
  const SeedPoints seeds = seedLattice(lobes, 3.0, 0.0, 1);
  const Vec3 steps = (seeds.byRegion[0].front() - seeds.byRegion[1].front()) / 3.0;
  EXPECT_NEAR((steps - Vec3(steps.array().round())).norm(), 0.0, 1e-9);
}

TEST(Seeding, GivesExactlyTheNumberAskedFor) {
  const std::vector<LobeRegion> lobes = {{Lobe::RightUpper, ball(50.0)},
                                         {Lobe::RightLower, box({60, 0, 0}, {100, 40, 40})}};
  for (const std::size_t count : {50U, 1000U, 20001U}) {
    const SeedPoints seeds = seedExactly(lobes, count, 0.0, 1);
    EXPECT_EQ(seeds.count(), count);
    const double share = static_cast<double>(seeds.byRegion[0].size()) / static_cast<double>(count);
    EXPECT_NEAR(share, 523599.0 / (523599.0 + 64000.0), 0.06);
  }
}

TEST(Seeding, JitterMovesPointsButKeepsThemInside) {
  const std::vector<LobeRegion> lobes = {{Lobe::Whole, ball(20.0)}};
  const SeedPoints still = seedLattice(lobes, 2.0, 0.0, 5);
  const SeedPoints moved = seedLattice(lobes, 2.0, 0.8, 5);
  const SeedPoints again = seedLattice(lobes, 2.0, 0.8, 5);
  const SeedPoints other = seedLattice(lobes, 2.0, 0.8, 6);
  ASSERT_EQ(still.count(), moved.count());
  double shift = 0.0;
  for (std::size_t i = 0; i < still.count(); ++i) {
    const Vec3& p = moved.byRegion[0][i];
    ASSERT_TRUE(lobes[0].domain->contains(p));
    ASSERT_LE((p - still.byRegion[0][i]).cwiseAbs().maxCoeff(), 0.8 + 1e-12);
    shift += (p - still.byRegion[0][i]).norm();
  }
  EXPECT_GT(shift / static_cast<double>(still.count()), 0.5);
  EXPECT_EQ(moved.byRegion, again.byRegion);
  EXPECT_NE(moved.byRegion, other.byRegion);
}

TEST(Seeding, RefusesALobeThatGetsNoPoint) {
  const std::vector<LobeRegion> metres = {{Lobe::RightUpper, ball(0.08)}};
  try {
    seedLattice(metres, 3.0, 0.0, 1);
    FAIL() << "a lobe of 0.16 mm got a point";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("units"));
  }
}

TEST(Seeding, RefusesMorePointsThanFitMemory) {
  const std::vector<LobeRegion> micrometres = {{Lobe::RightUpper, ball(80000.0)}};
  EXPECT_THROW(seedLattice(micrometres, 3.0, 0.0, 1), InvalidInput);
}

}  // namespace
}  // namespace pneuma
