#include "growth/centroid_splitting.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/branch_order.h"
#include "anatomy/right_lung.h"
#include "anatomy/validation.h"
#include "core/units.h"
#include "growth/point_splitter.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::ball;
using testing::box;

SplitRules paperRules() {
  return {.minAngleRad = radians(20.0),
          .maxAngleRad = radians(60.0),
          .containment = Containment::None,
          .spacingMm = 3.2298};
}

SplitInlet fromAbove() { return {Vec3::Zero(), -Vec3::UnitZ(), Vec3::UnitX()}; }

TEST(PointSplitter, FivePointsAreATerminal) {
  const std::vector<Vec3> points(5, Vec3(0, 0, -30));
  const SplitTree tree = splitPoints(fromAbove(), points, *ball(100.0), paperRules());
  EXPECT_TRUE(tree.branches.empty());
  EXPECT_EQ(tree.inletPoints, 5U);
}

TEST(PointSplitter, SixPointsSplitInTwoAlongTheCentroids) {
  // Three points on each side of the plane of the branch and its parent (y = 0).
  std::vector<Vec3> points;
  for (const double x : {-1.0, 0.0, 1.0}) {
    points.emplace_back(x, -20.0, -30.0);
    points.emplace_back(x, 20.0, -30.0);
  }
  const SplitTree tree = splitPoints(fromAbove(), points, *ball(100.0), paperRules());
  ASSERT_EQ(tree.branches.size(), 2U);
  for (const SplitBranch& branch : tree.branches) {
    EXPECT_EQ(branch.parent, -1);
    EXPECT_EQ(branch.points, 3U);
    // 0.41 of the way from the mother's end to the centroid (0, +-20, -30); 33.7 degrees: no clamp.
    EXPECT_NEAR(branch.end.norm(), 0.41 * std::hypot(20.0, 30.0), 0.05);
    EXPECT_NEAR(std::abs(branch.end.y()) / -branch.end.z(), 20.0 / 30.0, 0.005);
  }
}

TEST(PointSplitter, TurnsBranchesIntoTheAngleLimitsWithoutChangingTheirLength) {
  for (const auto& [sideways, expectedDeg] : {std::pair(4.0, 20.0), std::pair(90.0, 60.0)}) {
    std::vector<Vec3> points;
    for (const double x : {-1.0, 0.0, 1.0}) {
      points.emplace_back(x, -sideways, -30.0);
      points.emplace_back(x, sideways, -30.0);
    }
    const SplitTree tree = splitPoints(fromAbove(), points, *ball(200.0), paperRules());
    ASSERT_EQ(tree.branches.size(), 2U);
    for (const SplitBranch& branch : tree.branches) {
      EXPECT_NEAR(degrees(angleBetween(branch.end, -Vec3::UnitZ())), expectedDeg, 1e-6);
      EXPECT_NEAR(branch.end.norm(), 0.41 * std::hypot(sideways, 30.0), 0.05);
    }
  }
}

TEST(PointSplitter, BooksThePointsOfADaughterThatIsTooShortToItsMother) {
  std::vector<Vec3> points;
  for (const double x : {-0.2, 0.0, 0.2}) {
    points.emplace_back(x, -1.0, -1.0);  // 0.41 * 1.4 mm is shorter than 1.2 mm
    points.emplace_back(x, 20.0, -30.0);
  }
  const SplitTree tree = splitPoints(fromAbove(), points, *ball(100.0), paperRules());
  ASSERT_EQ(tree.branches.size(), 1U);
  EXPECT_EQ(tree.branches[0].points, 3U);
  EXPECT_EQ(tree.inletPoints, 3U);
  EXPECT_EQ(tree.counts.dropped, 1U);
  EXPECT_EQ(tree.counts.droppedPoints, 3U);
}

TEST(PointSplitter, SplitsAcrossTheWidestSpreadWhereBranchAndParentAreInLine) {
  std::vector<Vec3> points;
  for (const double y : {-2.0, 0.0, 2.0}) {
    points.emplace_back(-20.0, y, -30.0);
    points.emplace_back(20.0, y, -30.0);
  }
  const SplitInlet inline_{Vec3::Zero(), -Vec3::UnitZ(), -Vec3::UnitZ()};
  const SplitTree tree = splitPoints(inline_, points, *ball(100.0), paperRules());
  ASSERT_EQ(tree.branches.size(), 2U);
  EXPECT_NEAR(std::abs(tree.branches[0].end.x()), 0.41 * 20.0, 0.05);
}

/// An L-shaped lobe: branches that cut the corner would leave it.
class LShape : public Domain {
 public:
  bool contains(const Vec3& p) const override {
    const bool shaft = Box3(Vec3(-20, -20, -100), Vec3(20, 20, 0)).contains(p);
    const bool foot = Box3(Vec3(-20, -20, -100), Vec3(120, 20, -80)).contains(p);
    return shaft || foot;
  }

  double distanceToWall(const Vec3&) const override { return 0.0; }

  Box3 bounds() const override { return {Vec3(-20, -20, -100), Vec3(120, 20, 0)}; }

  double volumeMm3() const override { return 40.0 * 40.0 * 100.0 + 100.0 * 40.0 * 20.0; }
};

AirwayTree trunkAt(const Vec3& from, const Vec3& to) {
  AirwayTree tree;
  tree.add({.proximal = from, .distal = to, .radiusMm = 5.0, .origin = Origin::Template});
  return tree;
}

TEST(CentroidSplitting, StaysInsideAConcaveLobeAsFarAsItIsAskedTo) {
  const std::vector<LobeRegion> lobes = {{Lobe::Whole, std::make_shared<LShape>()}};
  const AirwayTree trunk = trunkAt({0, 0, 20}, {0, 0, -5});
  const auto outside = [&](Containment containment) {
    const GrowthResult result =
        growByCentroidSplitting(trunk, lobes, {.spacingMm = 2.0, .containment = containment});
    EXPECT_GT(terminalCount(result.tree), 3000U);
    return outsideTheirLobe(result.tree, lobes);
  };
  EXPECT_GT(outside(Containment::None).ends, 0U);
  EXPECT_EQ(outside(Containment::Ends).ends, 0U);
  EXPECT_GT(outside(Containment::Ends).segments, 0U);
  EXPECT_EQ(outside(Containment::Branches).segments, 0U);
}

TEST(CentroidSplitting, GivesEachPointToTheNearestOfSeveralInlets) {
  const std::vector<LobeRegion> lobes = {{Lobe::Whole, box({-50, -20, -40}, {50, 20, 0})}};
  AirwayTree central = trunkAt({0, 0, 30}, {0, 0, 10});
  for (const double x : {-25.0, 25.0}) {
    central.add({.parent = 0,
                 .proximal = {0, 0, 10},
                 .distal = {x, 0, -5},
                 .radiusMm = 3.0,
                 .origin = Origin::Measured});
  }
  const GrowthResult result =
      growByCentroidSplitting(central, lobes, {.spacingMm = 2.0, .containment = Containment::None});
  for (const Branch& branch : result.tree) {
    if (branch.origin != Origin::Grown) continue;
    // Walk up to the inlet: its half holds the branch's end, but for the step over the middle that
    // the smallest angle allows.
    int inlet = branch.parent;
    while (inlet > 2) inlet = result.tree[static_cast<std::size_t>(inlet)].parent;
    EXPECT_GT(branch.distal.x() * (inlet == 1 ? -1.0 : 1.0), -3.0);
  }
}

TEST(CentroidSplitting, HitsTheNumberOfTerminalsAskedFor) {
  const std::vector<LobeRegion> lobes = {{Lobe::RightUpper, ball(60.0)}};
  const AirwayTree trunk = trunkAt({0, 0, 90}, {0, 0, 50});
  for (const std::uint64_t wanted : {500U, 3000U, 30000U}) {
    const GrowthResult result = growByCentroidSplitting(trunk, lobes, {.terminals = wanted});
    EXPECT_NEAR(static_cast<double>(terminalCount(result.tree)), static_cast<double>(wanted),
                0.03 * static_cast<double>(wanted));
  }
}

TEST(CentroidSplitting, ADifferentSeedGivesADifferentTreeOfTheSameKind) {
  const std::vector<LobeRegion> lobes = {{Lobe::RightUpper, ball(50.0)}};
  const AirwayTree trunk = trunkAt({0, 0, 80}, {0, 0, 40});
  const auto ends = [&](std::uint64_t seed) {
    return growByCentroidSplitting(trunk, lobes, {.jitter = 1.0, .seed = seed}).tree;
  };
  const AirwayTree one = ends(1);
  const AirwayTree two = ends(2);
  EXPECT_NE(one[one.size() - 1].distal, two[two.size() - 1].distal);
  EXPECT_NEAR(static_cast<double>(one.size()), static_cast<double>(two.size()),
              0.05 * static_cast<double>(one.size()));
}

TEST(CentroidSplitting, RefusesAngleLimitsThatCross) {
  const std::vector<LobeRegion> lobes = {{Lobe::RightUpper, ball(50.0)}};
  EXPECT_THROW(growByCentroidSplitting(trunkAt({0, 0, 80}, {0, 0, 40}), lobes,
                                       {.minAngleDeg = 50.0, .maxAngleDeg = 40.0}),
               InvalidOption);
}

// Huang 2004, Table 1 and section 3, at the paper's ratio; all rows: `pneuma reproduce huang-2004`.
TEST(CentroidSplitting, ReproducesThePapersRightLung) {
  const RightLung lung = rightLung();
  const GrowthResult result = growByCentroidSplitting(lung.central, lung.lobes, {.points = 103894});
  const AirwayTree& tree = result.tree;
  const Children children(tree);
  const std::vector<int> generation = generations(tree);
  double all = 0.0;
  double middle = 0.0;
  double depth = 0.0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!children.isTerminal(i)) continue;
    all += 1.0;
    if (tree[i].lobe != Lobe::RightMiddle) continue;
    middle += 1.0;
    depth += generation[i];
  }
  EXPECT_NEAR(all, 16141.0, 0.03 * 16141.0);
  EXPECT_NEAR(middle, 2975.0, 0.05 * 2975.0);
  EXPECT_NEAR(depth / middle, 15.33, 0.1);
}

}  // namespace
}  // namespace pneuma
