#include "growth/kitaoka.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/central_airways.h"
#include "anatomy/efficiency.h"
#include "anatomy/organ.h"
#include "anatomy/validation.h"
#include "core/error.h"
#include "growth/row_kernels.h"
#include "support/plain_kitaoka.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;

struct Grown {
  GrowthResult result;
  Efficiency efficiency;

  double figure(const std::string& name) const {
    for (const auto& [key, value] : result.figures) {
      if (key == name) return value;
    }
    ADD_FAILURE() << "no figure " << name;
    return 0.0;
  }
};

Grown grownInSimpleOrgan(const KitaokaOptions& options) {
  static const Organ organ = simpleOrgan();
  const std::vector<LobeRegion> lobes = {organ.region};
  Grown grown{growByKitaoka(organ.central, lobes, options), {}};
  grown.efficiency = efficiency(grown.result.tree, lobes, simpleOrganCubes());
  return grown;
}

KitaokaOptions coarse() {
  KitaokaOptions options = kitaokaPaper();
  options.flowThreshold = 6e-4;
  return options;
}

TEST(Kitaoka, ReachesThePublishedFiguresOfTheSimpleOrgan) {
  const Grown grown = grownInSimpleOrgan(kitaokaPaper());
  const Efficiency& figures = grown.efficiency;
  EXPECT_NEAR(static_cast<double>(figures.branches), 55627.0, 0.015 * 55627.0);
  EXPECT_LE(figures.qf, 0.005);
  EXPECT_NEAR(figures.ca.value(), 0.36, 0.03);
  EXPECT_NEAR(figures.paper.vr, 0.030, 0.001);
  EXPECT_NEAR(figures.paper.el, 0.012, 0.001);
  EXPECT_NEAR(grown.figure("rotation_mean_deg"), 90.0, 1.0);
  EXPECT_NEAR(grown.figure("rotation_sd_deg"), 7.0, 2.0);
  EXPECT_NEAR(grown.figure("length_to_diameter_mean"), 3.06, 0.10);
  EXPECT_EQ(figures.branches, 2 * figures.terminals - 1);  // rule 1: dichotomous
}

TEST(Kitaoka, AgreesWithThePlainReadingOfThePaper) {
  const Organ organ = simpleOrgan();
  KitaokaOptions options = kitaokaPaper();
  options.flowThreshold = 1.5e-4;  // the deeper, the less a single branch's chance counts
  const testing::PlainTree plain = testing::growPlainly(*organ.region.domain, organ.central[0],
                                                        Vec3::UnitX(), options.flowThreshold);
  const Grown grown = grownInSimpleOrgan(options);
  const auto branches = static_cast<double>(plain.branches);
  EXPECT_NEAR(static_cast<double>(grown.efficiency.branches), branches, 0.01 * branches);
  EXPECT_NEAR(grown.efficiency.qf, plain.failedFlow, 0.005);
  EXPECT_NEAR(grown.efficiency.ca.value(), plain.terminalFlowVariation, 0.015);
  EXPECT_NEAR(grown.efficiency.airwayVolumeMl, plain.airwayVolumeMl, 0.01 * plain.airwayVolumeMl);
  EXPECT_NEAR(grown.figure("length_to_diameter_mean"), plain.lengthToDiameter, 0.03);
}

TEST(Kitaoka, GrowsTheSameTreeWithEveryInstructionSet) {
  std::vector<AirwayTree> trees;
  for (const auto set : {InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512}) {
    if (!available(set)) continue;
    const RowKernelChoice choice(set);
    trees.push_back(grownInSimpleOrgan(coarse()).result.tree);
  }
  for (const AirwayTree& tree : trees) {
    ASSERT_EQ(tree.size(), trees.front().size());
    for (std::size_t i = 0; i < tree.size(); ++i) {
      ASSERT_EQ(tree[i].distal, trees.front()[i].distal) << i;
      ASSERT_EQ(tree[i].radiusMm, trees.front()[i].radiusMm) << i;
    }
  }
}

TEST(Kitaoka, WithoutItsSupplementaryRulesFailsAsInThePaper) {
  KitaokaOptions options = kitaokaPaper();
  options.rule4a = options.rule6a = options.rule7a = options.rule8a = Switch::Off;
  const Grown grown = grownInSimpleOrgan(options);
  EXPECT_NEAR(static_cast<double>(grown.efficiency.branches), 5737.0, 0.08 * 5737.0);
  EXPECT_NEAR(grown.efficiency.qf, 0.882, 0.09);
  EXPECT_NEAR(grown.figure("rotation_sd_deg"), 0.0, 1e-6);        // rule 8a is off
  EXPECT_NEAR(grown.figure("length_to_diameter_sd"), 0.0, 1e-6);  // rule 7a is off
}

TEST(Kitaoka, SaysWhyEveryTerminalEnded) {
  KitaokaOptions options = coarse();
  options.rule8a = Switch::Off;
  const Grown grown = grownInSimpleOrgan(options);
  const Children children(grown.result.tree);
  double failures = 0.0;
  for (std::size_t i = 0; i < grown.result.tree.size(); ++i) {
    const Ending ending = grown.result.tree[i].ending;
    EXPECT_EQ(ending != Ending::None, children.isTerminal(i)) << i;
    failures += ending == Ending::LeftRegion || ending == Ending::Ratio ? 1.0 : 0.0;
  }
  EXPECT_GT(failures, 0.0);
  EXPECT_EQ(failures, grown.figure("failed_left_region") + grown.figure("failed_ratio"));
}

TEST(Kitaoka, ForUsersFailsNowhereAndStaysInside) {
  const Organ organ = simpleOrgan();
  const std::vector<LobeRegion> lobes = {organ.region};
  const GrowthResult result = growByKitaoka(organ.central, lobes, {.flowThreshold = 6e-4});
  EXPECT_TRUE(std::ranges::none_of(result.tree, [](const Branch& branch) {
    return branch.ending == Ending::LeftRegion || branch.ending == Ending::Ratio;
  }));
  const Outside outside = outsideTheirLobe(result.tree, lobes);
  EXPECT_EQ(outside.ends, 0U);
  EXPECT_EQ(outside.segments, 0U);
  EXPECT_TRUE(problems(result.tree).empty());
}

TEST(Kitaoka, AimsAtTheNumberOfTerminals) {
  KitaokaOptions options;
  options.terminals = 2000;
  const Grown grown = grownInSimpleOrgan(options);
  EXPECT_NEAR(static_cast<double>(grown.efficiency.terminals), 2000.0, 20.0);
}

TEST(Kitaoka, SymmetryEvensTheTerminals) {
  KitaokaOptions options = coarse();
  const double asThePaper = grownInSimpleOrgan(options).efficiency.ca.value();
  options.symmetry = 0.4;
  EXPECT_LT(grownInSimpleOrgan(options).efficiency.ca.value(), 0.8 * asThePaper);
}

TEST(Kitaoka, FluctuationGivesAnotherTreeWithTheSameStatistics) {
  KitaokaOptions options = kitaokaPaper();
  options.lengthSpread = 0.3;
  options.rotationSpreadDeg = 5.0;
  const Grown one = grownInSimpleOrgan(options);
  options.seed = 2;
  const Grown two = grownInSimpleOrgan(options);
  EXPECT_NE(one.result.tree[100].distal, two.result.tree[100].distal);
  for (const Grown* grown : {&one, &two}) {
    EXPECT_NEAR(static_cast<double>(grown->efficiency.branches), 55627.0, 0.03 * 55627.0);
    EXPECT_NEAR(grown->efficiency.ca.value(), 0.36, 0.03);
    EXPECT_NEAR(grown->figure("rotation_mean_deg"), 90.0, 2.0);
  }
}

TEST(Kitaoka, RefusesATreeThatMemoryWouldNotHold) {
  const Organ organ = simpleOrgan();
  const std::vector<LobeRegion> lobes = {organ.region};
  try {
    growByKitaoka(organ.central, lobes, {.flowThreshold = 1e-8});
    FAIL() << "began to grow";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::OutOfMemory);
    EXPECT_THAT(error.what(), HasSubstr("million branches"));
    EXPECT_THAT(error.what(), HasSubstr("GB"));
  }
}

TEST(Kitaoka, RefusesATrunkThatPointsOut) {
  const Organ organ = simpleOrgan();
  const std::vector<LobeRegion> lobes = {organ.region};
  AirwayTree upwards;
  Branch trunk = organ.central[0];
  trunk.proximal = {0, 0, -80};
  trunk.distal = {0, 0, -2};  // close below the apex
  upwards.add(trunk);
  try {
    growByKitaoka(upwards, lobes, {});
    FAIL() << "grew out of the organ";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("points out"));
    EXPECT_THAT(error.what(), HasSubstr("turn it round"));
  }
}

TEST(Kitaoka, RefusesATrunkOutsideTheOrgan) {
  const Organ organ = simpleOrgan();
  const std::vector<LobeRegion> lobes = {organ.region};
  AirwayTree outside;
  Branch trunk = organ.central[0];
  trunk.distal = {0, 0, 50};
  trunk.proximal = {0, 0, 90};
  outside.add(trunk);
  EXPECT_THROW(growByKitaoka(outside, lobes, {}), InvalidInput);
}

TEST(Kitaoka, RefusesCrossedLimits) {
  const Organ organ = simpleOrgan();
  const std::vector<LobeRegion> lobes = {organ.region};
  EXPECT_THROW(
      growByKitaoka(organ.central, lobes, {.minDistanceToLength = 6.0, .maxDistanceToLength = 3.0}),
      InvalidOption);
}

TEST(Kitaoka, RefusesAReachThatNoRegionKeeps) {
  const Organ organ = simpleOrgan();
  const std::vector<LobeRegion> lobes = {organ.region};
  EXPECT_THROW(growByKitaoka(organ.central, lobes, {.reach = 0.2}), InvalidOption);
}

TEST(Kitaoka, ReachKeepsSheavesOfLongTerminalsFromALongOrgan) {
  const std::vector<LobeRegion> lobes = {
      {Lobe::Whole, testing::box({-120, -20, -60}, {120, 20, 0})}};
  const AirwayTree central = templateAirways(lobes);
  KitaokaOptions options;
  options.terminals = 1000;
  const auto longestTerminalMm = [&](double reach) {
    options.reach = reach;
    const AirwayTree tree = growByKitaoka(central, lobes, options).tree;
    double longest = 0.0;
    for (const Branch& branch : tree) {
      if (branch.ending != Ending::None) longest = std::max(longest, lengthMm(branch));
    }
    return longest;
  };
  EXPECT_LT(longestTerminalMm(1.3), 0.7 * longestTerminalMm(0.0));
}

}  // namespace
}  // namespace pneuma
