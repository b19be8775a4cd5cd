#include "growth/aggregate_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/validation.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

/// A trunk down to the origin, and particles 1 mm apart that are told one by one.
class AggregateTree : public ::testing::Test {
 protected:
  AggregateTree() {
    Branch trunk;
    trunk.proximal = {0, 0, 30};
    trunk.distal = {0, 0, 0};
    trunk.radiusMm = 5.0;
    trunk.origin = Origin::Template;
    tree.add(trunk);
    aggregate.region = {Lobe::RightUpper, testing::box({-50, -50, -50}, {50, 50, 50})};
    aggregate.seeds.push_back({Vec3::Zero(), 0, {}});
  }

  /// Adds `count` particles in a row and returns the last one's number.
  int row(int from, const Vec3& way, int count) {
    Vec3 at = from < 0 ? aggregate.seeds[static_cast<std::size_t>(~from)].point
                       : aggregate.positions[static_cast<std::size_t>(from)];
    int parent = from;
    for (int i = 0; i < count; ++i) {
      at += way;
      aggregate.positions.push_back(at);
      aggregate.parents.push_back(parent);
      parent = static_cast<int>(aggregate.positions.size()) - 1;
    }
    return parent;
  }

  AirwayTree tree;
  LobeAggregate aggregate;
};

TEST_F(AggregateTree, AChainIsOneBranch) {
  row(~0, {0, 0, -1}, 10);
  const AggregateTips tips = appendAggregate(tree, aggregate, {1, 0});
  EXPECT_EQ(tips.all, 1U);
  ASSERT_EQ(tree.size(), 2U);
  EXPECT_EQ(tree[1].parent, 0);
  EXPECT_EQ(tree[1].distal, Vec3(0, 0, -10));
  EXPECT_DOUBLE_EQ(lengthMm(tree[1]), 10.0);
  EXPECT_EQ(tree[1].lobe, Lobe::RightUpper);
  EXPECT_DOUBLE_EQ(tree[1].suppliedMl, 1000.0);
}

TEST_F(AggregateTree, BranchesWhereAParticleHasTwoDaughters) {
  const int fork = row(~0, {0, 0, -1}, 5);
  row(fork, {1, 0, 0}, 6);
  row(fork, {-1, 0, 0}, 7);
  appendAggregate(tree, aggregate, {1, 0});
  ASSERT_EQ(tree.size(), 4U);
  EXPECT_EQ(tree[1].distal, Vec3(0, 0, -5));
  EXPECT_EQ(tree[2].parent, 1);
  EXPECT_EQ(tree[3].parent, 1);
  EXPECT_DOUBLE_EQ(tree[2].suppliedMl, 500.0);
  EXPECT_DOUBLE_EQ(tree[1].suppliedMl, 0.0);
}

TEST_F(AggregateTree, LeavesShortTwigsOutButNotTheWayOn) {
  const int fork = row(~0, {0, 0, -1}, 5);
  row(fork, {1, 0, 0}, 3);
  const int second = row(fork, {-1, 0, 0}, 4);
  row(second, {0, 1, 0}, 2);
  row(second, {0, -1, 0}, 3);
  const AggregateTips tips = appendAggregate(tree, aggregate, {4, 0});
  EXPECT_EQ(tips.all, 3U);
  EXPECT_EQ(tips.kept, 1U);
  ASSERT_EQ(tree.size(), 2U);
  EXPECT_EQ(tree[1].distal, Vec3(-4, -3, -5)) << "the tallest twig is the way on";
}

TEST_F(AggregateTree, KeepsTheLongestTwigWhereAllAreShort) {
  row(~0, {0, 0, -1}, 2);
  row(~0, {1, 0, 0}, 3);
  EXPECT_EQ(appendAggregate(tree, aggregate, {50, 0}).kept, 1U);
  ASSERT_EQ(tree.size(), 2U);
  EXPECT_EQ(tree[1].distal, Vec3(3, 0, 0));
}

TEST_F(AggregateTree, SmoothsTheStaircaseAndKeepsTheTips) {
  int at = ~0;
  for (int i = 0; i < 10; ++i) at = row(row(at, {1, 0, 0}, 1), {0, 0, -1}, 1);
  appendAggregate(tree, aggregate, {1, 3});
  ASSERT_EQ(tree.size(), 2U);
  EXPECT_EQ(tree[1].distal, Vec3(10, 0, -10));
  EXPECT_LT(lengthMm(tree[1]), 15.5) << "20 along the lattice, 14.1 straight";
  for (const CentrelinePoint& point : tree[1].via) {
    EXPECT_LT(std::abs(point.position.x() + point.position.z()), 0.7);
  }
}

TEST_F(AggregateTree, SmoothsNothingOutOfTheLobe) {
  // Round a corner of an L: the straight way cuts it.
  class Corner : public Domain {
   public:
    bool contains(const Vec3& p) const override {
      return std::abs(p.y()) < 0.5 && ((std::abs(p.x()) < 0.45 && p.z() > -10.45) ||
                                       (std::abs(p.z() + 10.0) < 0.45 && p.x() > -0.45));
    }

    bool containsSegment(const Vec3& a, const Vec3& b) const override {
      for (int i = 0; i <= 100; ++i) {
        if (!contains(a + (b - a) * (i / 100.0))) return false;
      }
      return true;
    }

    double distanceToWall(const Vec3&) const override { return 0.0; }

    Box3 bounds() const override { return {Vec3(-1, -1, -11), Vec3(30, 1, 30)}; }

    double volumeMm3() const override { return 1000.0; }
  };

  aggregate.region.domain = std::make_shared<Corner>();
  row(row(~0, {0, 0, -1}, 10), {1, 0, 0}, 10);
  appendAggregate(tree, aggregate, {1, 4});
  EXPECT_EQ(outsideTheirLobe(tree, std::vector<LobeRegion>{aggregate.region}).segments, 0U);
  EXPECT_THAT(problems(tree), ::testing::ElementsAre("branch 1 has no radius"));
}

TEST_F(AggregateTree, ASideBranchOfAnAirwayStartsAtTheAirwaysEnd) {
  aggregate.seeds.push_back({Vec3(0, 0, 12), 0, {Vec3(0, 0, 5)}});
  row(~1, {1, 0, 0}, 4);
  appendAggregate(tree, aggregate, {1, 0});
  ASSERT_EQ(tree.size(), 2U);
  EXPECT_EQ(tree[1].proximal, tree[0].distal);
  EXPECT_DOUBLE_EQ(lengthMm(tree[1]), 16.0) << "12 mm back along the airway, 4 mm out";
}

}  // namespace
}  // namespace pneuma
