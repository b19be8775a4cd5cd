#include "anatomy/efficiency.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "support/progress_recorder.h"
#include "support/sample_trees.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::addBranch;
using testing::box;

/// Two cubes of 30 mm side by side along x, from the origin.
std::vector<LobeRegion> twoCubes() { return {{Lobe::Whole, box({0, 0, 0}, {60, 30, 30})}}; }

Branch branchTo(const Vec3& end, double suppliedMl, Ending ending = Ending::Flow) {
  Branch branch;
  branch.parent = 0;
  branch.proximal = {30, 15, 15};
  branch.distal = end;
  branch.radiusMm = 1.0;
  branch.suppliedMl = suppliedMl;
  branch.ending = ending;
  return branch;
}

/// A trunk of 20 mm, 4 mm wide, with daughters 2 mm wide to `ends`.
AirwayTree trunkWith(const std::vector<Branch>& daughters) {
  AirwayTree tree;
  Branch trunk;
  trunk.proximal = {30, 15, 35};
  trunk.distal = {30, 15, 15};
  trunk.radiusMm = 2.0;
  tree.add(trunk);
  for (const Branch& daughter : daughters) tree.add(daughter);
  return tree;
}

/// Three terminals in the left cube, one in the right one; the last has failed.
AirwayTree fourTerminals() {
  return trunkWith({branchTo({20, 15, 15}, 1.0), branchTo({10, 15, 15}, 3.0),
                    branchTo({30, 25, 15}, 4.0), branchTo({45, 15, 15}, 8.0, Ending::Ratio)});
}

TEST(Efficiency, CountsBranchesTerminalsAndFailures) {
  const Efficiency e = efficiency(fourTerminals(), twoCubes());
  EXPECT_EQ(e.branches, 5U);
  EXPECT_EQ(e.terminals, 4U);
  EXPECT_EQ(e.failed, 1U);
}

TEST(Efficiency, FailedFlowIsTheShareOfFailedTerminals) {
  AirwayTree tree = fourTerminals();
  EXPECT_DOUBLE_EQ(efficiency(tree, twoCubes()).qf, 8.0 / 16.0);
  tree.add(branchTo({50, 15, 15}, 4.0, Ending::LeftRegion));
  EXPECT_DOUBLE_EQ(efficiency(tree, twoCubes()).qf, 12.0 / 20.0);
}

TEST(Efficiency, TerminalsOfUnknownEndingAreGood) {
  const AirwayTree tree = trunkWith(
      {branchTo({20, 15, 15}, 1.0, Ending::None), branchTo({40, 15, 15}, 3.0, Ending::None)});
  const Efficiency e = efficiency(tree, twoCubes());
  EXPECT_EQ(e.failed, 0U);
  EXPECT_EQ(e.qf, 0.0);
  EXPECT_TRUE(e.ca.has_value());
}

TEST(Efficiency, AcinarVariationIsThatOfGoodTerminalsOnly) {
  // Flows 1, 3, 4 of 16: mean 8/3, squares of the deviations 25/9 + 1/9 + 16/9 = 42/9.
  const Efficiency e = efficiency(fourTerminals(), twoCubes());
  ASSERT_TRUE(e.ca.has_value());
  EXPECT_NEAR(*e.ca, std::sqrt(42.0 / 9.0 / 2.0) / (8.0 / 3.0), 1e-12);
}

TEST(Efficiency, TerminalsThatSupplyNothingAreNoAcini) {
  AirwayTree tree = fourTerminals();
  const double before = *efficiency(tree, twoCubes()).ca;
  tree.add(branchTo({50, 20, 15}, 0.0, Ending::None));
  EXPECT_NEAR(*efficiency(tree, twoCubes()).ca, before, 1e-12);
}

TEST(Efficiency, AirwayVolumeIsTakenOf6388MlAndOfTheOrgan) {
  const Efficiency e = efficiency(fourTerminals(), twoCubes());
  // Daughters of 10, 20, 10 and 15 mm.
  const double ml = std::numbers::pi * (4.0 * 20.0 + 55.0) / 1000.0;
  EXPECT_NEAR(e.airwayVolumeMl, ml, 1e-12);
  EXPECT_NEAR(e.paper.vr, ml / 6388.0, 1e-15);
  EXPECT_NEAR(e.today.vr, ml / 54.0, 1e-15);
  EXPECT_EQ(e.paper.lungVolumeMl, 6388.0);
  EXPECT_NEAR(e.today.lungVolumeMl, 54.0, 1e-12);
}

TEST(Efficiency, EnergyLossIsThatOfFlowsAndWidthsInUnitsOfTheTrunk) {
  const Efficiency e = efficiency(fourTerminals(), twoCubes());
  // L / D0 Q^2 / (d / D0)^4 with D0 = 4 mm; daughters are half as wide.
  const double trunk = 20.0 / 4.0;
  const double daughters =
      16.0 / 4.0 * (10.0 * 1.0 * 1.0 + 20.0 * 3.0 * 3.0 + 10.0 * 4.0 * 4.0 + 15.0 * 8.0 * 8.0) /
      (16.0 * 16.0);
  EXPECT_NEAR(e.paper.el, 4.0 * (trunk + daughters) / 4.0, 1e-12);
  EXPECT_NEAR(e.today.el, 128.0 / std::numbers::pi * (trunk + daughters) / 4.0, 1e-10);
}

TEST(Efficiency, DensityIsCountedInWholeCubesAlsoOfFailedTerminals) {
  // The end at x = 30 lies in the right cube: 2 terminals in each, whatever their ending.
  const Efficiency equal = efficiency(fourTerminals(), twoCubes());
  EXPECT_EQ(equal.paper.cubeCount, 2U);
  ASSERT_TRUE(equal.paper.cn.has_value());
  EXPECT_NEAR(*equal.paper.cn, 0.0, 1e-12);
  AirwayTree tree = fourTerminals();
  for (const double y : {5.0, 8.0}) tree.add(branchTo({45, y, 15}, 1.0, Ending::LeftRegion));
  // 2 and 4: mean 3, standard deviation sqrt(2).
  EXPECT_NEAR(*efficiency(tree, twoCubes()).paper.cn, std::sqrt(2.0) / 3.0, 1e-12);
}

TEST(Efficiency, PaperLeavesOutCubesLessThanHalfInsideAndDoesNotDivideByTheirShare) {
  // A third cube of which 20 or 10 of 30 mm are inside.
  const AirwayTree tree = trunkWith({branchTo({10, 15, 15}, 1.0), branchTo({40, 15, 15}, 1.0),
                                     branchTo({50, 15, 15}, 1.0), branchTo({65, 15, 15}, 1.0)});
  const std::vector<LobeRegion> most = {{Lobe::Whole, box({0, 0, 0}, {80, 30, 30})}};
  const Efficiency withThird = efficiency(tree, most);
  EXPECT_EQ(withThird.paper.cubeCount, 3U);
  EXPECT_NEAR(*withThird.paper.cn, std::sqrt((2.0 / 3.0) / 2.0) / (4.0 / 3.0), 1e-12);
  const std::vector<LobeRegion> least = {{Lobe::Whole, box({0, 0, 0}, {70, 30, 30})}};
  EXPECT_EQ(efficiency(tree, least).paper.cubeCount, 2U);
}

TEST(Efficiency, LobesThatMeetInACubeFillItTogether) {
  const std::vector<LobeRegion> halves = {{Lobe::RightUpper, box({0, 0, 0}, {14.9, 30, 30})},
                                          {Lobe::RightLower, box({14.9, 0, 0}, {60, 30, 30})}};
  EXPECT_EQ(efficiency(fourTerminals(), halves).paper.cubeCount, 2U);
}

TEST(Efficiency, TheLatticeHasACornerAtItsNode) {
  const Efficiency shifted =
      efficiency(fourTerminals(), twoCubes(), {.node = {15, 0, 0}, .leastInside = 0.9});
  EXPECT_EQ(shifted.paper.cubeCount, 1U);  // x from 15 to 45 only
  EXPECT_FALSE(shifted.paper.cn.has_value());
  EXPECT_FALSE(shifted.paper.pi.has_value());
}

TEST(Efficiency, IndexIsThePlainSum) {
  AirwayTree tree = fourTerminals();
  tree.add(branchTo({45, 5, 15}, 1.0));
  const Efficiency e = efficiency(tree, twoCubes());
  ASSERT_TRUE(e.paper.pi.has_value());
  EXPECT_DOUBLE_EQ(*e.paper.pi, e.qf + *e.paper.cn + *e.ca + e.paper.vr + e.paper.el);
}

TEST(Efficiency, TodaysCubesHold40TerminalsSoThatRandomOnesVaryBy16Percent) {
  // 64,000 terminals in 8 l: cubes of 17.1 mm. Poisson's law gives 1 / sqrt(40).
  Random random(5);
  AirwayTree tree;
  addBranch(tree, -1, {0, 0, -1});
  for (int i = 0; i < 64000; ++i) {
    const double x = random.uniform(0, 200);
    const double y = random.uniform(0, 200);
    tree.add(branchTo({x, y, random.uniform(0, 200)}, 1.0));
  }
  const std::vector<LobeRegion> organ = {{Lobe::Whole, box({0, 0, 0}, {200, 200, 200})}};
  const Efficiency e = efficiency(tree, organ);
  EXPECT_NEAR(e.today.cubes.edgeMm, std::cbrt(40.0 * 8e6 / 64000.0), 1e-9);
  EXPECT_NEAR(*e.today.cn, 1.0 / std::sqrt(40.0), 0.006);
}

TEST(Efficiency, TodayDividesByWhatOfACubeIsInside) {
  // The second of two cubes lacks one edge, 6 of its 216 sample points.
  const std::vector<LobeRegion> organ = {{Lobe::RightUpper, box({0, 0, 0}, {60, 30, 25})},
                                         {Lobe::RightMiddle, box({0, 0, 25}, {60, 25, 30})},
                                         {Lobe::RightLower, box({0, 25, 25}, {30, 30, 30})}};
  AirwayTree tree;
  addBranch(tree, -1, {0, 0, -1});
  const auto addEnds = [&tree](int count, const Vec3& end) {
    for (int i = 0; i < count; ++i) tree.add(branchTo(end, 1.0));
  };
  addEnds(36, {10, 10, 10});
  addEnds(35, {50, 10, 10});
  addEnds(8, {10, 100, 10});  // outside; the 79 together make the edges 30 mm
  const Efficiency e = efficiency(tree, organ);
  EXPECT_NEAR(e.today.cubes.edgeMm, 30.0, 0.02);
  EXPECT_EQ(e.today.cubeCount, 2U);
  EXPECT_NEAR(*e.today.cn, 0.0, 1e-9);
  EXPECT_GT(*e.paper.cn, 0.01);
}

TEST(Efficiency, ThoraxCubesAreShiftedByHalfACube) {
  EXPECT_EQ(thoraxCubes().node, Vec3(15, 0, 0));
  EXPECT_EQ(thoraxCubes().leastInside, 0.7);
  EXPECT_EQ(simpleOrganCubes().edgeMm, 30.0);
  EXPECT_EQ(simpleOrganCubes().leastInside, 0.5);
}

TEST(Efficiency, IsTheSameForAnyNumberOfThreads) {
  const auto measured = [] {
    return efficiency(fourTerminals(), {{{Lobe::Whole, testing::ball(40.0, {30, 15, 15})}}});
  };
  const Efficiency all = measured();
  const ThreadLimit one(1);
  EXPECT_EQ(measured().paper.cn, all.paper.cn);
  EXPECT_EQ(measured().today.cubeCount, all.today.cubeCount);
}

TEST(Efficiency, RefusesWhatHasNone) {
  EXPECT_THROW(efficiency({}, twoCubes()), InvalidInput);
  EXPECT_THROW(efficiency(fourTerminals(), {}), InvalidInput);
}

TEST(Efficiency, StopsOnRequest) {
  testing::ProgressRecorder stopped(0.0);
  EXPECT_THROW(efficiency(fourTerminals(), twoCubes(), {}, Progress(stopped)), Cancelled);
  testing::ProgressRecorder recorder;
  efficiency(fourTerminals(), twoCubes(), {}, Progress(recorder));
  ASSERT_FALSE(recorder.fractions().empty());
  EXPECT_EQ(recorder.fractions().back(), 1.0);
}

}  // namespace
}  // namespace pneuma
