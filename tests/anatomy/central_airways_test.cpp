#include "anatomy/central_airways.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/validation.h"
#include "core/error.h"
#include "support/sample_trees.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::addBranch;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Five balls where the lobes lie; LPS: the right lung is at negative x.
std::vector<LobeRegion> fiveBalls() {
  return {{Lobe::RightUpper, testing::ball(40, Vec3(-80, 0, 60))},
          {Lobe::RightMiddle, testing::ball(30, Vec3(-80, -60, -10))},
          {Lobe::RightLower, testing::ball(45, Vec3(-80, 30, -50))},
          {Lobe::LeftUpper, testing::ball(45, Vec3(80, -20, 50))},
          {Lobe::LeftLower, testing::ball(45, Vec3(80, 30, -50))}};
}

/// Trachea with a bronchus to the centre of every lobe.
AirwayTree starInto(const std::vector<LobeRegion>& lobes) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -10));
  for (const LobeRegion& region : lobes) {
    addBranch(tree, 0, region.domain->bounds().center() - tree[0].distal);
  }
  return tree;
}

TEST(AssignLobes, FindsTheLobeOfEveryTerminal) {
  const auto lobes = fiveBalls();
  AirwayTree tree = starInto(lobes);
  const std::vector<Inlet> inlets = assignLobes(tree, lobes);
  ASSERT_EQ(inlets.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(inlets[i].branch, i + 1);
    EXPECT_EQ(inlets[i].region, i);
    EXPECT_EQ(tree[i + 1].lobe, lobes[i].lobe);
  }
  EXPECT_EQ(tree[0].lobe, Lobe::Central);
}

TEST(AssignLobes, MarksBranchesAllOfWhoseTerminalsShareALobe) {
  const std::array<LobeRegion, 1> lobes = {{{Lobe::LeftLower, testing::ball(50)}}};
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -10));  // below it: one end inside, one outside
  addBranch(tree, 0, Vec3(0, 0, -10));
  addBranch(tree, 1, Vec3(5, 0, -5));
  addBranch(tree, 1, Vec3(-5, 0, -5));
  addBranch(tree, 0, Vec3(200, 0, 0));
  const std::vector<Inlet> inlets = assignLobes(tree, lobes);
  EXPECT_EQ(inlets.size(), 2U);
  EXPECT_EQ(tree[0].lobe, Lobe::Central);
  EXPECT_EQ(tree[1].lobe, Lobe::LeftLower);
  EXPECT_EQ(tree[3].lobe, Lobe::LeftLower);
  EXPECT_EQ(tree[4].lobe, Lobe::Central);
}

TEST(AssignLobes, NamesTheLobeThatNoAirwayReaches) {
  auto lobes = fiveBalls();
  AirwayTree tree = starInto(lobes);
  lobes[1].domain = testing::ball(5, Vec3(-80, -60, 200));
  try {
    assignLobes(tree, lobes);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("right middle lobe"));
  }
}

TEST(AssignLobes, SaysThatFramesOrUnitsMayDifferWhereNothingMeets) {
  const auto lobes = fiveBalls();
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, 9000));
  try {
    assignLobes(tree, lobes);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("units"));
  }
}

TEST(TemplateAirways, EndOnceInEveryLobe) {
  const auto lobes = fiveBalls();
  AirwayTree tree = templateAirways(lobes);
  EXPECT_THAT(problems(tree), IsEmpty());
  const std::vector<Inlet> inlets = assignLobes(tree, lobes);
  EXPECT_EQ(inlets.size(), 5U);
  for (const Branch& branch : tree) EXPECT_EQ(branch.origin, Origin::Template);
}

TEST(TemplateAirways, RightBronchiLieOnTheRight) {
  const AirwayTree tree = templateAirways(fiveBalls());
  for (const Branch& branch : tree) {
    if (branch.lobe == Lobe::Central) continue;
    EXPECT_EQ(branch.distal.x() < 0.0, side(branch.lobe) == Side::Right);
  }
}

TEST(TemplateAirways, OneRegionGetsOneTrunkFromAbove) {
  const std::array<LobeRegion, 1> organ = {{{Lobe::Whole, testing::ball(60, Vec3(5, 6, 7))}}};
  const AirwayTree tree = templateAirways(organ);
  ASSERT_EQ(tree.size(), 1U);
  EXPECT_GT(tree[0].proximal.z(), 67.0);
  EXPECT_TRUE(organ[0].domain->contains(tree[0].distal));
}

TEST(TemplateAirways, OneLungAloneIsServedToo) {
  auto lobes = fiveBalls();
  lobes.resize(3);
  AirwayTree tree = templateAirways(lobes);
  EXPECT_THAT(problems(tree), IsEmpty());
  EXPECT_EQ(assignLobes(tree, lobes).size(), 3U);
}

TEST(TemplateAirways, NeedALobe) { EXPECT_THROW(templateAirways({}), InvalidInput); }

}  // namespace
}  // namespace pneuma
