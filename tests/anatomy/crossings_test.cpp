#include "anatomy/crossings.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "support/progress_recorder.h"
#include "support/sample_trees.h"

namespace pneuma {
namespace {

using testing::addBranch;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

int addStraight(AirwayTree& tree, int parent, const Vec3& from, const Vec3& to, double radiusMm) {
  Branch branch;
  branch.parent = parent;
  branch.proximal = from;
  branch.distal = to;
  branch.radiusMm = radiusMm;
  return tree.add(branch);
}

/// Two strangers: terminals of roots of their own.
AirwayTree strangers(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1,
                     double radiusMm) {
  AirwayTree tree;
  addStraight(tree, -1, a0, a1, radiusMm);
  addStraight(tree, -1, b0, b1, radiusMm);
  return tree;
}

TEST(Crossings, TwoTubesThatCrossCountOnce) {
  const AirwayTree tree =
      strangers(Vec3(-50, 0, 0), Vec3(50, 0, 0), Vec3(0, -50, 1.9), Vec3(0, 50, 1.9), 1.0);
  EXPECT_THAT(crossings(tree), ElementsAre(Pair(0, 1)));
}

TEST(Crossings, TubesThatPassByDoNot) {
  const AirwayTree tree =
      strangers(Vec3(-50, 0, 0), Vec3(50, 0, 0), Vec3(0, -50, 2.1), Vec3(0, 50, 2.1), 1.0);
  EXPECT_THAT(crossings(tree), IsEmpty());
}

TEST(Crossings, LongTubesSideBySideCountOnce) {
  const AirwayTree tree =
      strangers(Vec3(0, 0, 0), Vec3(100, 0, 0), Vec3(0, 1.5, 0), Vec3(100, 1.5, 0), 1.0);
  EXPECT_THAT(crossings(tree), ElementsAre(Pair(0, 1)));
}

TEST(Crossings, EndsAreRounded) {
  EXPECT_THAT(
      crossings(strangers(Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(11.9, 0, 0), Vec3(20, 0, 0), 1.0)),
      ElementsAre(Pair(0, 1)));
  EXPECT_THAT(
      crossings(strangers(Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(12.1, 0, 0), Vec3(20, 0, 0), 1.0)),
      IsEmpty());
}

TEST(Crossings, FollowTheMeasuredCentreline) {
  AirwayTree tree;
  Branch detour;
  detour.proximal = Vec3(-50, 0, 0);
  detour.distal = Vec3(50, 0, 0);
  detour.radiusMm = 1.0;
  detour.via = {{Vec3(0, 40, 0), 1.0}};
  tree.add(detour);
  addStraight(tree, -1, Vec3(0, 0, -20), Vec3(0, 0, 20), 1.0);    // through the straight way
  addStraight(tree, -1, Vec3(0, 40, -20), Vec3(0, 40, 20), 1.0);  // through the detour
  EXPECT_THAT(crossings(tree), ElementsAre(Pair(0, 2)));
}

/// Three generations below a root, all tubes so wide and short that everything overlaps.
AirwayTree bush() {
  return testing::SymmetricTree{
      .generations = 4, .lengthMm = [](int) { return 0.1; }, .diameterMm = [](int) { return 20.0; }}
      .tree();
}

TEST(Crossings, KinDoNotCount) {
  // Branches 0 | 1 2 | 3 4 5 6 | 7 .. 14. Not kin: with two or more branches between them.
  const auto pairs = crossings(bush());
  const std::set<std::pair<std::size_t, std::size_t>> found(pairs.begin(), pairs.end());
  EXPECT_EQ(found.size(), pairs.size());
  EXPECT_FALSE(found.contains({0, 1}));  // mother and daughter
  EXPECT_FALSE(found.contains({1, 2}));  // sisters
  EXPECT_FALSE(found.contains({0, 3}));  // grandmother
  EXPECT_FALSE(found.contains({2, 3}));  // aunt and niece
  EXPECT_TRUE(found.contains({0, 7}));   // great-grandmother
  EXPECT_TRUE(found.contains({3, 5}));   // cousins
  EXPECT_TRUE(found.contains({2, 7}));   // great-aunt
  // 15 * 14 / 2 pairs less 14 mothers, 7 sisters, 12 grandmothers, 12 aunts.
  EXPECT_EQ(pairs.size(), 105U - 45U);
}

TEST(Crossings, KinDoNotDependOnTheOrderOfBranches) {
  // Stored depth first: the niece (2) comes before her aunt (3).
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -0.1), 10.0);
  addBranch(tree, 0, Vec3(0.1, 0, 0), 10.0);
  addBranch(tree, 1, Vec3(0.1, 0, 0), 10.0);
  addBranch(tree, 0, Vec3(-0.1, 0, 0), 10.0);
  addBranch(tree, 1, Vec3(0, 0.1, 0), 10.0);
  EXPECT_THAT(crossings(tree), IsEmpty());
}

TEST(Crossings, OneDaughterStepsAreOneBranch) {
  AirwayTree tree;
  int last = addBranch(tree, -1, Vec3(0, 0, -1), 1.0);
  for (int i = 0; i < 20; ++i) last = addBranch(tree, last, Vec3(0, 0, -0.2), 1.0);
  addBranch(tree, last, Vec3(5, 0, 0), 1.0);
  addBranch(tree, last, Vec3(-5, 0, 0), 1.0);
  EXPECT_THAT(crossings(tree), IsEmpty());
  addStraight(tree, -1, Vec3(-10, 0, -2), Vec3(10, 0, -2), 0.1);  // through many steps of the chain
  EXPECT_THAT(crossings(tree), ElementsAre(Pair(0, 23)));
}

TEST(Crossings, AreThoseFoundByTryingAllPairs) {
  Random random(11);
  const auto point = [&] {
    const double x = random.uniform(0, 30);
    const double y = random.uniform(0, 30);
    return Vec3(x, y, random.uniform(0, 30));
  };
  AirwayTree tree;
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = point();
    addStraight(tree, -1, from, from + 0.3 * (point() - from), random.uniform(0.05, 0.6));
  }
  std::vector<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t a = 0; a < tree.size(); ++a) {
    for (std::size_t b = a + 1; b < tree.size(); ++b) {
      // By sampling both centre lines; pairs too close to call are not in this set of numbers.
      double nearest = 1e9;
      for (int s = 0; s <= 100; ++s) {
        const Vec3 p = tree[a].proximal + (tree[a].distal - tree[a].proximal) * (s / 100.0);
        const Vec3 along = tree[b].distal - tree[b].proximal;
        const double t =
            std::clamp((p - tree[b].proximal).dot(along) / along.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (tree[b].proximal + t * along - p).norm());
      }
      const double reach = tree[a].radiusMm + tree[b].radiusMm;
      if (nearest < reach) expected.emplace_back(a, b);
    }
  }
  ASSERT_GT(expected.size(), 20U);
  EXPECT_EQ(crossings(tree), expected);
}

TEST(Crossings, DoNotDependOnThreads) {
  const auto many = crossings(bush());
  const ThreadLimit oneThread(1);
  EXPECT_EQ(crossings(bush()), many);
}

TEST(Crossings, OfNothing) {
  EXPECT_THAT(crossings({}), IsEmpty());
  AirwayTree point;
  addBranch(point, -1, Vec3::Zero(), 0.0);
  EXPECT_THAT(crossings(point), IsEmpty());
}

TEST(Crossings, RefuseATreeWhoseRadiiAreInAnotherUnit) {
  const AirwayTree tree = testing::SymmetricTree{.generations = 12,
                                                 .lengthMm = [](int) { return 0.001; },
                                                 .diameterMm = [](int) { return 5.0; }}
                              .tree();
  EXPECT_THROW(crossings(tree), InvalidInput);
}

TEST(Crossings, StopOnRequest) {
  testing::ProgressRecorder stop(0.5);
  EXPECT_THROW(crossings(bush(), Progress(stop)), Cancelled);
}

}  // namespace
}  // namespace pneuma
