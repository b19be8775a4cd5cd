#include "anatomy/validation.h"

#include <array>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/sample_trees.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::addBranch;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Branch branchBetween(int parent, const Vec3& proximal, const Vec3& distal) {
  Branch branch;
  branch.parent = parent;
  branch.proximal = proximal;
  branch.distal = distal;
  branch.radiusMm = 1.0;
  return branch;
}

TEST(Problems, AGoodTreeHasNone) {
  EXPECT_THAT(problems(testing::SymmetricTree{}.tree()), IsEmpty());
}

TEST(Problems, NamesTwoRootsAndNone) {
  AirwayTree tree;
  EXPECT_THAT(problems(tree), ElementsAre(HasSubstr("0 roots")));
  addBranch(tree, -1, Vec3(0, 0, -1));
  addBranch(tree, -1, Vec3(0, 0, 1));
  EXPECT_THAT(problems(tree), ElementsAre(HasSubstr("2 roots")));
}

TEST(Problems, NamesAGapBetweenParentAndChild) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  tree.add(branchBetween(0, Vec3(0, 0, -1.001), Vec3(0, 0, -2)));
  EXPECT_THAT(problems(tree), ElementsAre(HasSubstr("branch 1 does not start")));
}

TEST(Problems, NamesMissingLengthAndRadius) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  addBranch(tree, 0, Vec3::Zero());
  addBranch(tree, 0, Vec3(1, 0, 0), 0.0);
  EXPECT_THAT(problems(tree), ElementsAre(HasSubstr("branch 1 has no length"),
                                          HasSubstr("branch 2 has no radius")));
}

TEST(Problems, NamesNumbersThatAreNone) {
  AirwayTree tree;
  const double none = std::numeric_limits<double>::quiet_NaN();
  tree.add(branchBetween(-1, Vec3::Zero(), Vec3(0, none, 0)));
  Branch noRadius = branchBetween(-1, Vec3::Zero(), Vec3(0, 1, 0));
  noRadius.radiusMm = none;
  AirwayTree second;
  second.add(noRadius);
  EXPECT_THAT(problems(tree), ::testing::Contains(HasSubstr("not numbers")));
  EXPECT_THAT(problems(second), ElementsAre(HasSubstr("no radius")));
}

TEST(OutsideTheirLobe, CountsEndsAndSegmentsOfGrownBranches) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, 5), 1.0, Lobe::RightUpper);  // inside
  addBranch(tree, 0, Vec3(0, 0, 20), 1.0, Lobe::RightUpper);  // ends outside
  addBranch(tree, 0, Vec3(0, 0, 30), 1.0, Lobe::LeftLower);   // of no region given
  const int measured = addBranch(tree, 0, Vec3(0, 0, 40), 1.0, Lobe::RightUpper);
  tree.setOrigin(static_cast<std::size_t>(measured), Origin::Measured);
  const std::array<LobeRegion, 1> lobes = {{{Lobe::RightUpper, testing::ball(10.0)}}};
  const Outside outside = outsideTheirLobe(tree, lobes);
  EXPECT_EQ(outside.ends, 1U);
  EXPECT_EQ(outside.segments, 1U);
}

/// Two boxes side by side with a gap between them.
class TwoBoxes : public Domain {
 public:
  bool contains(const Vec3& p) const override {
    return std::abs(p.y()) < 5.0 && std::abs(p.z()) < 5.0 && std::abs(p.x()) < 10.0 &&
           std::abs(p.x()) > 2.0;
  }

  double distanceToWall(const Vec3&) const override { return 0.0; }

  Box3 bounds() const override { return {Vec3(-10, -5, -5), Vec3(10, 5, 5)}; }

  double volumeMm3() const override { return 1600.0; }
};

TEST(OutsideTheirLobe, NoticesABranchThatLeavesAndComesBack) {
  AirwayTree tree;
  tree.add(branchBetween(-1, Vec3(-5, 0, 0), Vec3(5, 0, 0)));
  const std::array<LobeRegion, 1> lobes = {{{Lobe::Whole, std::make_shared<TwoBoxes>()}}};
  const Outside outside = outsideTheirLobe(tree, lobes);
  EXPECT_EQ(outside.ends, 0U);
  EXPECT_EQ(outside.segments, 1U);
}

}  // namespace
}  // namespace pneuma
