#include "anatomy/branching_angles.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "support/sample_trees.h"

namespace pneuma {
namespace {

using testing::addBranch;
using testing::SymmetricTree;

TEST(BranchingAngles, AreThoseTheTreeWasBuiltWith) {
  for (const double deg : {35.0, 45.0, 90.0, 150.0}) {
    const AirwayTree tree = SymmetricTree{.generations = 6, .angleDeg = deg}.tree();
    const std::vector<BranchingAngle> angles = branchingAngles(tree);
    EXPECT_EQ(angles.size(), tree.size() - 1);
    for (const BranchingAngle& angle : angles) EXPECT_NEAR(degrees(angle.radians), deg, 1e-9);
  }
}

TEST(BranchingAngles, OneDaughterStepsDoNotCount) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  addBranch(tree, 0, Vec3(1, 0, 0));  // a step that turns by 90 degrees
  addBranch(tree, 1, Vec3(1, 1, 0));
  addBranch(tree, 1, Vec3(1, -1, 0));
  const std::vector<BranchingAngle> angles = branchingAngles(tree);
  ASSERT_EQ(angles.size(), 2U);
  for (const BranchingAngle& angle : angles) EXPECT_NEAR(degrees(angle.radians), 45.0, 1e-9);
}

TEST(BranchingAngles, TheMajorDaughterIsTheWider) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  addBranch(tree, 0, Vec3(1, 0, -1), 0.5);
  addBranch(tree, 0, Vec3(-1, 0, -1), 0.7);
  const std::vector<BranchingAngle> angles = branchingAngles(tree);
  ASSERT_EQ(angles.size(), 2U);
  EXPECT_FALSE(angles[0].major);
  EXPECT_TRUE(angles[1].major);
}

TEST(BranchingAngles, FlowDecidesBetweenEquallyWideDaughters) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  addBranch(tree, 0, Vec3(1, 0, -1));
  addBranch(tree, 0, Vec3(-1, 0, -1));
  addBranch(tree, 2, Vec3(-1, 0, -1));
  addBranch(tree, 2, Vec3(-1, 0, 0));
  const std::vector<BranchingAngle> angles = branchingAngles(tree);
  ASSERT_EQ(angles.size(), 4U);
  EXPECT_FALSE(angles[0].major);
  EXPECT_TRUE(angles[1].major);
}

TEST(BranchingAngles, BranchesWithoutLengthHaveNone) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  addBranch(tree, 0, Vec3::Zero());
  addBranch(tree, 0, Vec3(-1, 0, -1));
  EXPECT_EQ(branchingAngles(tree).size(), 1U);
}

class RotationAngles : public ::testing::TestWithParam<double> {};

TEST_P(RotationAngles, AreThoseTheTreeWasBuiltWithFolded) {
  const double deg = GetParam();
  const AirwayTree tree = SymmetricTree{.generations = 6, .rotationDeg = deg}.tree();
  const std::vector<RotationAngle> angles = rotationAngles(tree);
  // Every mother but the root has a plane and a plane above it: 2 + 4 + 8 + 16.
  EXPECT_EQ(angles.size(), 30U);
  const double folded = deg > 90.0 ? 180.0 - deg : deg;
  for (const RotationAngle& angle : angles) EXPECT_NEAR(degrees(angle.radians), folded, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Degrees, RotationAngles, ::testing::Values(0.0, 30.0, 90.0, 120.0, 180.0));

TEST(RotationAngle, PassesOverOneDaughterSteps) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  addBranch(tree, 0, Vec3(1, 0, -1));  // plane normal y
  addBranch(tree, 0, Vec3(-1, 0, -1));
  addBranch(tree, 1, Vec3(0, 0, -1));  // a step
  addBranch(tree, 3, Vec3(0, 1, -1));  // plane normal x
  addBranch(tree, 3, Vec3(0, -1, -1));
  const std::vector<RotationAngle> angles = rotationAngles(tree);
  ASSERT_EQ(angles.size(), 1U);
  EXPECT_EQ(angles[0].mother, 3U);
  EXPECT_NEAR(degrees(angles[0].radians), 90.0, 1e-9);
}

TEST(RotationAngle, NeedsAPlaneOnBothSides) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  for (const double x : {-1.0, 0.0, 1.0}) addBranch(tree, 0, Vec3(x, 0, -1));  // three daughters
  addBranch(tree, 1, Vec3(0, 1, -1));
  addBranch(tree, 1, Vec3(0, -1, -1));
  EXPECT_TRUE(rotationAngles(tree).empty());
}

}  // namespace
}  // namespace pneuma
