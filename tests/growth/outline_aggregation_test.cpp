#include "growth/outline_aggregation.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/validation.h"
#include "core/error.h"

namespace pneuma {
namespace {

OutlineAggregate grown(OutlineAggregationOptions options) { return growInOutline(options); }

TEST(OutlineAggregation, TakesThePapersTenThousandParticlesBeforeItIsSaturated) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const OutlineAggregate aggregate = grown({.seed = seed});
    EXPECT_EQ(aggregate.end, AggregationEnd::Complete) << seed;
    EXPECT_EQ(aggregate.cluster.positions.size(), 10000U);
    for (const double reached : aggregate.reached) EXPECT_GT(reached, 0.5) << seed;
    EXPECT_NEAR(static_cast<double>(aggregate.tips.all) / 10000.0, 0.23, 0.03);
  }
}

TEST(OutlineAggregation, IsSaturatedNotFarBeyond) {
  const OutlineAggregate aggregate = grown({.particles = 30000});
  EXPECT_EQ(aggregate.end, AggregationEnd::Saturated);
  EXPECT_NEAR(static_cast<double>(aggregate.cluster.positions.size()), 10700.0, 1100.0);
}

TEST(OutlineAggregation, HasEightyKeyPointsAndASoundTree) {
  const OutlineAggregate aggregate = grown({.particles = 2000});
  EXPECT_EQ(aggregate.keyPoints.size(), 80U);
  EXPECT_THAT(problems(aggregate.tree), ::testing::IsEmpty());
  EXPECT_EQ(aggregate.stuck[0] + aggregate.stuck[1] + aggregate.stuck[2], 2000U);
  for (const Vec3& p : aggregate.cluster.positions) {
    EXPECT_EQ(p.y(), 0.0);
    EXPECT_LT(p.x(), 0.0) << "the right lung lies at negative x";
  }
}

TEST(OutlineAggregation, TheShareOfTheLaunchesSteersWhereItGrows) {
  const auto upperShare = [](double upper, double lower) {
    const OutlineAggregate aggregate = grown({.particles = 4000,
                                              .pixelMm = 0.4,
                                              .upper = upper,
                                              .middle = 1.0 - upper - lower,
                                              .lower = lower});
    return static_cast<double>(aggregate.stuck[0]) / 4000.0;
  };
  EXPECT_GT(upperShare(0.6, 0.2), upperShare(0.2, 0.6) + 0.25);
}

TEST(OutlineAggregation, TheProbabilityToStickHardlyDoes) {
  const auto upperShare = [](double upper, double lower) {
    const OutlineAggregate aggregate = grown({.particles = 4000,
                                              .pixelMm = 0.4,
                                              .reaction = ReactionProbability::Sticking,
                                              .upper = upper,
                                              .middle = 0.3,
                                              .lower = lower});
    return static_cast<double>(aggregate.stuck[0]) / 4000.0;
  };
  EXPECT_NEAR(upperShare(0.5, 0.2), upperShare(0.2, 0.5), 0.12);
}

TEST(OutlineAggregation, RefusesSharesThatDoNotSum) {
  try {
    grown({.upper = 0.5, .middle = 0.5, .lower = 0.5});
    FAIL();
  } catch (const InvalidOption& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("sum to 1.5"));
  }
}

TEST(OutlineAggregation, RefusesAirwaysOffTheLung) {
  EXPECT_THROW(grown({.seedXMm = -90.0}), InvalidOption);
}

TEST(OutlineAggregation, AStepOfTenIsCoarse) {
  const OutlineAggregate coarse = grown({.step = 10, .reach = 10});
  EXPECT_EQ(coarse.end, AggregationEnd::Saturated);
  EXPECT_LT(coarse.cluster.positions.size(), 1000U);
}

}  // namespace
}  // namespace pneuma
