#include "pipeline/variation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/summary.h"
#include "core/error.h"
#include "core/units.h"
#include "support/sample_trees.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

/// A ball of 100 mm about the origin with a trunk of 60 mm from its top straight down.
LungModel ballWithTrunk(Origin origin = Origin::Template) {
  LungModel model;
  model.regions = std::make_shared<const std::vector<LobeRegion>>(
      std::vector<LobeRegion>{{Lobe::Whole, testing::ball(100.0)}});
  AirwayTree central;
  Branch trunk;
  trunk.proximal = {0, 0, 100};
  trunk.distal = {0, 0, 40};
  trunk.radiusMm = 9.0;
  trunk.origin = origin;
  central.add(trunk);
  model.central = std::make_shared<const AirwayTree>(central);
  return model;
}

const Branch& trunkOf(const LungModel& model) { return (*model.central)[0]; }

TEST(Variation, OfNothingIsTheModelItself) {
  const LungModel model = ballWithTrunk();
  const LungModel same = varied(model, {}, 5);
  EXPECT_EQ(same.regions, model.regions);
  EXPECT_EQ(same.central, model.central);
}

TEST(Variation, TurnsTheTrunkAboutItsStart) {
  std::vector<double> turns;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const LungModel model = varied(ballWithTrunk(), {.trunkTurnDeg = 5.0}, seed);
    const Branch& trunk = trunkOf(model);
    EXPECT_EQ(trunk.proximal, Vec3(0, 0, 100));
    EXPECT_NEAR(lengthMm(trunk), 60.0, 1e-9);
    turns.push_back(degrees(angleBetween(direction(trunk), -Vec3::UnitZ())));
  }
  // The mean of |x| of a normal law is sqrt(2 / pi) of its standard deviation.
  const Summary s = summary(turns);
  EXPECT_NEAR(s.mean, 5.0 * 0.798, 0.4);
  EXPECT_LE(s.max, 15.0 + 1e-9);
}

TEST(Variation, ChangesTheTrunksLength) {
  std::vector<double> lengths;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const LungModel model = varied(ballWithTrunk(), {.trunkLength = 0.1}, seed);
    EXPECT_NEAR(angleBetween(direction(trunkOf(model)), -Vec3::UnitZ()), 0.0, 1e-9);
    lengths.push_back(lengthMm(trunkOf(model)));
  }
  EXPECT_NEAR(summary(lengths).mean, 60.0, 1.0);
  EXPECT_NEAR(summary(lengths).sd, 6.0, 0.7);
}

TEST(Variation, ScalesOrganAndAirwaysTogether) {
  const LungModel model = varied(ballWithTrunk(), {.organScale = 0.1}, 3);
  const Branch& trunk = trunkOf(model);
  const double factor = lengthMm(trunk) / 60.0;
  EXPECT_NE(factor, 1.0);
  EXPECT_NEAR(trunk.radiusMm, 9.0 * factor, 1e-9);
  EXPECT_TRUE(trunk.proximal.isApprox(Vec3(0, 0, 100.0 * factor)));
  const double volume = ballWithTrunk().regions->front().domain->volumeMm3();
  EXPECT_NEAR(model.regions->front().domain->volumeMm3(), volume * factor * factor * factor, 1.0);
}

TEST(Variation, IsTheSameForTheSameSeedOnly) {
  const VariationOptions options{.trunkTurnDeg = 5.0, .trunkLength = 0.1, .organScale = 0.1};
  const auto end = [&](std::uint64_t seed) {
    return trunkOf(varied(ballWithTrunk(), options, seed)).distal;
  };
  EXPECT_EQ(end(1), end(1));
  EXPECT_NE(end(1), end(2));
}

TEST(Variation, MovesWhatHangsOnTheTrunk) {
  LungModel model = ballWithTrunk();
  AirwayTree central = *model.central;
  testing::addBranch(central, 0, {20, 0, -20});
  central.setOrigin(1, Origin::Template);
  model.central = std::make_shared<const AirwayTree>(central);
  const LungModel next = varied(model, {.trunkTurnDeg = 5.0, .trunkLength = 0.1}, 2);
  const Branch& daughter = (*next.central)[1];
  EXPECT_EQ(daughter.proximal, trunkOf(next).distal);
  EXPECT_NEAR(lengthMm(daughter), lengthMm(central[1]), 1e-9);
  EXPECT_NEAR(angleBetween(direction(daughter), direction(trunkOf(next))), radians(45.0), 1e-9);
}

TEST(Variation, KeepsEndsInTheirLobeOrSaysWhatToDo) {
  LungModel model = ballWithTrunk();
  AirwayTree central;
  Branch trunk = trunkOf(model);
  trunk.distal = {0, 0, -95};  // 5 mm before the wall
  central.add(trunk);
  model.central = std::make_shared<const AirwayTree>(central);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const LungModel next = varied(model, {.trunkLength = 0.1}, seed);
    EXPECT_LE(trunkOf(next).distal.norm(), 100.0);
  }
  model.regions = std::make_shared<const std::vector<LobeRegion>>(
      std::vector<LobeRegion>{{Lobe::Whole, testing::ball(1e-9, trunk.distal)}});
  try {
    varied(model, {.trunkTurnDeg = 5.0}, 1);
    ADD_FAILURE() << "the end left its lobe";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("make trunk-turn or trunk-length smaller"));
  }
}

TEST(Variation, LeavesMeasuredAirwaysAlone) {
  EXPECT_THROW(varied(ballWithTrunk(Origin::Measured), {.trunkTurnDeg = 5.0}, 1), InvalidInput);
  EXPECT_NO_THROW(varied(ballWithTrunk(Origin::Measured), {.organScale = 0.05}, 1));
}

TEST(Variation, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(varied(ballWithTrunk(), {.trunkTurnDeg = 50.0}, 1), InvalidOption);
  EXPECT_THROW(varied(ballWithTrunk(), {.organScale = -0.1}, 1), InvalidOption);
}

}  // namespace
}  // namespace pneuma
