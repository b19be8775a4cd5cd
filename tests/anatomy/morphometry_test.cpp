#include "anatomy/morphometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "anatomy/diameter_law.h"
#include "core/error.h"
#include "core/parallel.h"
#include "support/progress_recorder.h"
#include "support/sample_trees.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::addBranch;
using testing::SymmetricTree;

AirwayTree regularTree(Lobe lobe = Lobe::Whole) {
  return SymmetricTree{
      .generations = 6,
      .lengthMm = [](int z) { return 30.0 * std::pow(0.8, z); },
      .diameterMm = [](int z) { return 10.0 * std::pow(0.75, z); },
      .angleDeg = 45.0,
      .lobe = lobe,
  }
      .tree();
}

TEST(Morphometry, OfARegularTreeIsWhatItWasBuiltWith) {
  const Morphometry m = measure(regularTree());
  EXPECT_EQ(m.branches, 63U);
  EXPECT_EQ(m.branchesContracted, 63U);
  EXPECT_EQ(m.terminals, 32U);
  EXPECT_EQ(m.terminalGeneration.mean, 5.0);
  EXPECT_EQ(m.terminalGeneration.sd, 0.0);
  EXPECT_NEAR(m.terminalLengthMm.mean, 30.0 * std::pow(0.8, 5), 1e-9);
  EXPECT_NEAR(m.pathLengthMm.mean, 30.0 * (1.0 - std::pow(0.8, 6)) / 0.2, 1e-9);
  EXPECT_NEAR(m.branchingAngleDeg.mean, 45.0, 1e-9);
  EXPECT_EQ(m.branchingAngleDeg.count, 62U);
  EXPECT_EQ(m.branchingAngleMajorDeg.count, 31U);
  EXPECT_EQ(m.branchingAngleMinorDeg.count, 31U);
  EXPECT_NEAR(m.rotationAngleDeg.mean, 90.0, 1e-6);
  EXPECT_NEAR(m.lengthToParent.mean, 0.8, 1e-12);
  EXPECT_EQ(m.lengthToParentBelowOne, 1.0);
  EXPECT_NEAR(m.diameterToParent.mean, 0.75, 1e-12);
  EXPECT_NEAR(m.diameterMinorToMajor.mean, 1.0, 1e-12);
  EXPECT_NEAR(m.strahler.branching.ratio, 2.0, 1e-12);
  EXPECT_NEAR(m.strahler.length.ratio, 1.25, 1e-12);
  EXPECT_NEAR(m.horsfield.diameter.ratio, 4.0 / 3.0, 1e-12);
  EXPECT_EQ(m.boxDimension.size(), 5U);
  EXPECT_FALSE(m.gap.has_value());
}

TEST(Morphometry, DeadSpaceIsTheSumOfCylinders) {
  double volume = 0.0;
  for (int z = 0; z < 6; ++z) {
    const double d = 10.0 * std::pow(0.75, z);
    volume += std::pow(2.0, z) * std::numbers::pi / 4.0 * d * d * 30.0 * std::pow(0.8, z);
  }
  EXPECT_NEAR(measure(regularTree()).deadSpaceMl, volume / 1000.0, 1e-9);
}

TEST(Morphometry, DeadSpaceOfAMeasuredBranchIsItsCones) {
  AirwayTree tree;
  Branch branch;
  branch.proximal = Vec3::Zero();
  branch.distal = Vec3(0, 0, -30);
  branch.radiusMm = 99.0;  // not used where the centreline has radii of its own
  branch.via = {{Vec3(0, 0, -10), 4.0}, {Vec3(0, 0, -20), 2.0}};
  tree.add(branch);
  const double cylinders = std::numbers::pi * 10.0 * (16.0 + 4.0);
  const double cone = std::numbers::pi / 3.0 * 10.0 * (16.0 + 8.0 + 4.0);
  EXPECT_NEAR(measure(tree).deadSpaceMl, (cylinders + cone) / 1000.0, 1e-9);
}

TEST(Morphometry, AnglesByTheMothersDiameter) {
  const Morphometry m = measure(regularTree());
  const auto& classes = m.branchingAngleByParentDiameterDeg;
  ASSERT_EQ(classes.size(), 6U);
  // Mothers of generations 0-4 are 10, 7.5, 5.63, 4.22 and 3.16 mm wide.
  EXPECT_EQ(classes[0].first, ">4 mm");
  EXPECT_EQ(classes[0].second.count, 2U + 4U + 8U + 16U);
  EXPECT_EQ(classes[1].first, "4-3 mm");
  EXPECT_EQ(classes[1].second.count, 32U);
  EXPECT_EQ(classes[5].first, "<0.7 mm");
  EXPECT_EQ(classes[5].second.count, 0U);
  EXPECT_NEAR(classes[0].second.mean, 45.0, 1e-9);
}

TEST(Morphometry, DiameterClassesMeetAtTheirLimits) {
  for (const auto& [diameter, expected] :
       {std::pair{4.01, 0U}, {4.0, 1U}, {3.0, 2U}, {2.0, 3U}, {1.0, 4U}, {0.7, 5U}, {0.1, 5U}}) {
    const double mother = diameter;
    const AirwayTree tree =
        SymmetricTree{.generations = 2, .diameterMm = [=](int) { return mother; }}.tree();
    const auto classes = measure(tree).branchingAngleByParentDiameterDeg;
    EXPECT_EQ(classes[expected].second.count, 2U) << diameter;
  }
}

/// The tree of asymmetric forks that is worked out by hand in the tests below.
AirwayTree smallTree() {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -10), 2.0);  // joined with the step below: 12 mm
  addBranch(tree, 0, Vec3(0, 0, -2), 2.0);
  addBranch(tree, 1, Vec3(6, 0, 0), 1.5);   // terminal
  addBranch(tree, 1, Vec3(0, 0, -9), 1.0);  // 9 + 9 mm, bent
  addBranch(tree, 3, Vec3(9, 0, 0), 1.0);   // terminal
  return tree;
}

TEST(Morphometry, ProportionsAreThoseOfBranchesFromForkToFork) {
  const Morphometry m = measure(smallTree());
  EXPECT_EQ(m.branches, 5U);
  EXPECT_EQ(m.branchesContracted, 3U);
  EXPECT_EQ(m.terminals, 2U);
  EXPECT_NEAR(m.lengthToDiameter.mean, (12.0 / 4.0 + 6.0 / 3.0 + 18.0 / 2.0) / 3.0, 1e-12);
  EXPECT_NEAR(m.lengthToParent.mean, (0.5 + 1.5) / 2.0, 1e-12);
  EXPECT_EQ(m.lengthToParentBelowOne, 0.5);
  EXPECT_NEAR(m.diameterToParent.mean, (0.75 + 0.5) / 2.0, 1e-12);
  EXPECT_NEAR(m.diameterMinorToMajor.mean, 2.0 / 3.0, 1e-12);
  EXPECT_EQ(m.diameterMinorToMajor.count, 1U);
}

TEST(Morphometry, GenerationsAndTerminalLengthsCountOneDaughterSteps) {
  const Morphometry m = measure(smallTree());
  EXPECT_EQ(m.terminalGeneration.min, 2.0);
  EXPECT_EQ(m.terminalGeneration.max, 3.0);
  EXPECT_NEAR(m.terminalLengthMm.mean, (6.0 + 9.0) / 2.0, 1e-12);
  EXPECT_NEAR(m.pathLengthMm.min, 18.0, 1e-12);
  EXPECT_NEAR(m.pathLengthMm.max, 30.0, 1e-12);
}

TEST(Morphometry, HorsfieldAndStrahlerOrdersDifferInAnAsymmetricTree) {
  AirwayTree tree;  // single terminals part from a trunk: four terminals
  int last = addBranch(tree, -1, Vec3(0, 0, -9));
  for (int i = 0; i < 3; ++i) {
    addBranch(tree, last, Vec3(4, 0, -1));
    last = addBranch(tree, last, Vec3(0, 0, -9));
  }
  const Morphometry m = measure(tree);
  EXPECT_EQ(m.strahler.counts, (std::vector<std::size_t>{4, 1}));
  EXPECT_EQ(m.horsfield.counts, (std::vector<std::size_t>{4, 1, 1, 1}));
}

/// Weibel's regular model A (1963), generations 0 to 16.
AirwayTree weibelTree() {
  static constexpr std::array<double, 17> LengthMm = {
      120, 47.6, 19.0, 7.6, 12.7, 10.7, 9.0, 7.6, 6.4, 5.4, 4.6, 3.9, 3.3, 2.7, 2.3, 2.0, 1.65};
  return SymmetricTree{
      .generations = 17,
      .lengthMm = [](int z) { return LengthMm[static_cast<std::size_t>(z)]; },
      .diameterMm = weibelDiameterMm,
  }
      .tree();
}

TEST(Morphometry, OfWeibelsModelIsWhatWeibelFound) {
  const Morphometry m = measure(weibelTree());
  EXPECT_EQ(m.branches, 131071U);
  EXPECT_EQ(m.terminals, 65536U);
  EXPECT_EQ(m.terminalGeneration.mean, 16.0);
  EXPECT_NEAR(m.deadSpaceMl, 175.0, 1.0);
  EXPECT_NEAR(m.pathLengthMm.mean, 266.45, 1e-6);
  EXPECT_NEAR(m.horsfield.branching.ratio, 2.0, 1e-9);
  EXPECT_NEAR(m.horsfield.branching.r2, 1.0, 1e-9);
  EXPECT_NEAR(m.lengthToDiameter.max, 12.0 / 1.8, 1e-9);
  EXPECT_NEAR(m.lengthToDiameter.min, 7.6 / 5.6, 1e-9);
}

TEST(Morphometry, CrossingsAreCounted) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -100));
  addBranch(tree, 0, Vec3(-50, 0, 0));
  addBranch(tree, 0, Vec3(50, 0, 0));
  addBranch(tree, 1, Vec3(-5, 0, -50));
  addBranch(tree, 1, Vec3(-50, 0, -50));
  addBranch(tree, 2, Vec3(5, 0, -50));
  EXPECT_EQ(measure(tree).crossings, 0U);
  addBranch(tree, 2, Vec3(-200, 0, -50));  // through the whole of the other side
  EXPECT_EQ(measure(tree).crossings, 2U);
}

TEST(Morphometry, GapIsMeasuredWhereRegionsAreKnown) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0.5, 0.5, 0.5), 0.01);
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, 1.0}) addBranch(tree, 0, Vec3(x, y, z), 0.01);
  const std::array<LobeRegion, 1> lobes = {
      {{Lobe::Whole, testing::box(Vec3::Zero(), Vec3::Constant(2.0))}}};
  const Morphometry m = measure(tree, {.lobes = lobes, .seed = 1, .gapPoints = 50000});
  ASSERT_TRUE(m.gap.has_value());
  EXPECT_NEAR(m.gap->spacingMm, 1.0, 1e-12);
  EXPECT_NEAR(m.gap->mean, 0.4803, 0.005);
}

void expectEqual(const Summary& a, const Summary& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.sd, b.sd);
  EXPECT_EQ(a.min, b.min);
  EXPECT_EQ(a.max, b.max);
}

void expectEqual(const Morphometry& a, const Morphometry& b) {
  EXPECT_EQ(a.branches, b.branches);
  EXPECT_EQ(a.branchesContracted, b.branchesContracted);
  EXPECT_EQ(a.terminals, b.terminals);
  expectEqual(a.terminalGeneration, b.terminalGeneration);
  expectEqual(a.pathLengthMm, b.pathLengthMm);
  expectEqual(a.branchingAngleDeg, b.branchingAngleDeg);
  expectEqual(a.branchingAngleMajorDeg, b.branchingAngleMajorDeg);
  expectEqual(a.rotationAngleDeg, b.rotationAngleDeg);
  expectEqual(a.lengthToDiameter, b.lengthToDiameter);
  expectEqual(a.lengthToParent, b.lengthToParent);
  expectEqual(a.diameterMinorToMajor, b.diameterMinorToMajor);
  EXPECT_EQ(a.strahler.branching.ratio, b.strahler.branching.ratio);
  EXPECT_EQ(a.horsfield.length.r2, b.horsfield.length.r2);
  EXPECT_EQ(a.deadSpaceMl, b.deadSpaceMl);
  EXPECT_EQ(a.crossings, b.crossings);
  ASSERT_EQ(a.boxDimension.size(), b.boxDimension.size());
  for (std::size_t k = 0; k < a.boxDimension.size(); ++k) {
    EXPECT_EQ(a.boxDimension[k].dimension, b.boxDimension[k].dimension);
  }
  ASSERT_EQ(a.gap.has_value(), b.gap.has_value());
  if (!a.gap.has_value()) return;
  EXPECT_EQ(a.gap->mean, b.gap->mean);
  EXPECT_EQ(a.gap->p95, b.gap->p95);
  EXPECT_EQ(a.gap->max, b.gap->max);
  EXPECT_EQ(a.gap->spacingMm, b.gap->spacingMm);
}

TEST(MeasureByLobe, OfATreeInOneLobeIsTheWhole) {
  const AirwayTree tree = regularTree(Lobe::LeftUpper);
  const std::array<LobeRegion, 1> lobes = {{{Lobe::LeftUpper, testing::ball(150.0)}}};
  const MorphometryInput input{.lobes = lobes, .seed = 4, .gapPoints = 5000};
  const auto byLobe = measureByLobe(tree, input);
  ASSERT_EQ(byLobe.size(), 1U);
  ASSERT_TRUE(byLobe.at(Lobe::LeftUpper).gap.has_value());
  expectEqual(byLobe.at(Lobe::LeftUpper), measure(tree, input));
}

TEST(MeasureByLobe, ALobeIsSuppliedByItsOwnTerminalsOnly) {
  // The left terminal lies near the points of the right region, whose own terminal is far.
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, 1), 0.1, Lobe::Central);
  addBranch(tree, 0, Vec3(-9, 0, 0), 0.1, Lobe::RightUpper);
  addBranch(tree, 0, Vec3(1, 0, 0), 0.1, Lobe::LeftUpper);
  const std::array<LobeRegion, 2> lobes = {
      {{Lobe::RightUpper, testing::box(Vec3(-10, -1, 0), Vec3(0, 1, 2))},
       {Lobe::LeftUpper, testing::box(Vec3(0, -1, 0), Vec3(10, 1, 2))}}};
  const MorphometryInput input{.lobes = lobes, .seed = 1, .gapPoints = 20000};
  const auto byLobe = measureByLobe(tree, input);
  const Gap& right = byLobe.at(Lobe::RightUpper).gap.value();
  const Gap whole = measure(tree, input).gap.value();
  // The farthest corner of the right box is 9 mm and a bit away from its own terminal.
  EXPECT_NEAR(right.max * right.spacingMm, std::sqrt(81.0 + 1.0 + 1.0), 0.2);
  EXPECT_LT(whole.mean * whole.spacingMm, right.mean * right.spacingMm);
}

TEST(MeasureByLobe, PartsAddUpToTheWhole) {
  AirwayTree tree = regularTree();
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const int parent = tree[i].parent;
    const Lobe above = parent < 0 ? Lobe::Central : tree[static_cast<std::size_t>(parent)].lobe;
    tree.setLobe(i, i == 1 ? Lobe::RightUpper : i == 2 ? Lobe::LeftLower : above);
  }
  const std::array<LobeRegion, 2> lobes = {
      {{Lobe::RightUpper, testing::ball(80.0, Vec3(-40, 0, -70))},
       {Lobe::LeftLower, testing::ball(80.0, Vec3(40, 0, -70))}}};
  const auto byLobe = measureByLobe(tree, {.lobes = lobes, .seed = 1, .gapPoints = 1000});
  const Morphometry whole = measure(tree);
  ASSERT_EQ(byLobe.size(), 3U);
  std::size_t branches = 0;
  std::size_t terminals = 0;
  std::size_t angles = 0;
  double deadSpace = 0.0;
  for (const auto& [lobe, part] : byLobe) {
    branches += part.branches;
    terminals += part.terminals;
    angles += part.branchingAngleDeg.count;
    deadSpace += part.deadSpaceMl;
    EXPECT_EQ(part.gap.has_value(), lobe != Lobe::Central);
  }
  EXPECT_EQ(branches, whole.branches);
  EXPECT_EQ(terminals, whole.terminals);
  EXPECT_EQ(angles, whole.branchingAngleDeg.count);
  EXPECT_NEAR(deadSpace, whole.deadSpaceMl, 1e-9);
  EXPECT_EQ(byLobe.at(Lobe::Central).terminals, 0U);
  EXPECT_EQ(byLobe.at(Lobe::RightUpper).terminalGeneration.mean, 5.0);
}

TEST(Morphometry, DoesNotDependOnThreads) {
  const AirwayTree tree = regularTree();
  const std::array<LobeRegion, 1> lobes = {{{Lobe::Whole, testing::ball(150.0)}}};
  const MorphometryInput input{.lobes = lobes};
  const Morphometry many = measure(tree, input);
  const ThreadLimit oneThread(1);
  expectEqual(measure(tree, input), many);
}

TEST(Morphometry, OfOneBranchKnowsWhatItCannotKnow) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -12), 2.0);
  const Morphometry m = measure(tree);
  EXPECT_EQ(m.terminals, 1U);
  EXPECT_NEAR(m.lengthToDiameter.mean, 3.0, 1e-12);
  EXPECT_EQ(m.branchingAngleDeg.count, 0U);
  EXPECT_EQ(m.strahler.branching.ratio, 0.0);
}

TEST(Morphometry, OfNothingIsAnError) {
  EXPECT_THROW(measure({}), InvalidInput);
  EXPECT_THROW(measureByLobe({}), InvalidInput);
}

TEST(Morphometry, RefusesNumbersThatAreNone) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  addBranch(tree, 0, Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0));
  EXPECT_THROW(measure(tree), InvalidInput);
  for (const double radius : {-1.0, std::numeric_limits<double>::infinity()}) {
    AirwayTree other;
    addBranch(other, -1, Vec3(0, 0, -1), radius);
    EXPECT_THROW(measure(other), InvalidInput);
  }
}

TEST(Morphometry, ReportsProgressThatOnlyGrows) {
  testing::ProgressRecorder recorder;
  measure(regularTree(), {}, Progress(recorder));
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions()));
  ASSERT_FALSE(recorder.fractions().empty());
  EXPECT_EQ(recorder.fractions().back(), 1.0);
}

TEST(Morphometry, StopsOnRequestAtAnyTime) {
  const AirwayTree tree = regularTree();
  const std::array<LobeRegion, 1> lobes = {{{Lobe::Whole, testing::ball(150.0)}}};
  for (const double fraction : {0.0, 0.2, 0.6}) {
    testing::ProgressRecorder stop(fraction);
    EXPECT_THROW(measure(tree, {.lobes = lobes}, Progress(stop)), Cancelled) << fraction;
    testing::ProgressRecorder stopAgain(fraction);
    EXPECT_THROW(measureByLobe(tree, {.lobes = lobes}, Progress(stopAgain)), Cancelled);
  }
}

TEST(PublishedBands, AreBandsWithSources) {
  EXPECT_FALSE(publishedBands().empty());
  for (const PublishedBand& band : publishedBands()) {
    EXPECT_LE(band.low, band.high) << band.quantity;
    EXPECT_FALSE(band.source.empty()) << band.quantity;
  }
}

}  // namespace
}  // namespace pneuma
