#include "anatomy/airway_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/centreline.h"
#include "core/error.h"
#include "support/sample_trees.h"

namespace pneuma {
namespace {

using testing::addBranch;
using ::testing::ElementsAre;

TEST(Branch, LengthFollowsTheCentreline) {
  Branch branch;
  branch.proximal = Vec3(0, 0, 0);
  branch.distal = Vec3(3, 4, 0);
  EXPECT_DOUBLE_EQ(lengthMm(branch), 5.0);
  branch.via = {{Vec3(3, 0, 0), 1.0}};
  EXPECT_DOUBLE_EQ(lengthMm(branch), 7.0);
  EXPECT_TRUE(direction(branch).isApprox(Vec3(0.6, 0.8, 0)));
}

TEST(Branch, WithoutLengthHasNoDirection) {
  Branch branch;
  branch.proximal = branch.distal = Vec3(1, 2, 3);
  EXPECT_TRUE(direction(branch).isZero());
}

TEST(Branch, PiecesTakeTheRadiiOfTheirPoints) {
  Branch branch;
  branch.proximal = Vec3(0, 0, 0);
  branch.distal = Vec3(4, 0, 0);
  branch.radiusMm = 9.0;
  branch.via = {{Vec3(1, 0, 0), 3.0}, {Vec3(2, 0, 0), 2.0}};
  std::vector<double> from;
  std::vector<double> to;
  Vec3 last = branch.proximal;
  forEachPiece(branch, [&](const CentrelinePiece& piece) {
    EXPECT_TRUE(piece.from.isApprox(last));
    last = piece.to;
    from.push_back(piece.fromRadiusMm);
    to.push_back(piece.toRadiusMm);
  });
  EXPECT_TRUE(last.isApprox(branch.distal));
  EXPECT_THAT(from, ElementsAre(3.0, 3.0, 2.0));
  EXPECT_THAT(to, ElementsAre(3.0, 2.0, 2.0));
}

TEST(AirwayTree, RefusesAChildBeforeItsParent) {
  AirwayTree tree;
  Branch branch;
  branch.parent = 0;
  branch.proximal = branch.distal = Vec3::Zero();
  EXPECT_THROW(tree.add(branch), InvalidInput);
  branch.parent = -2;
  EXPECT_THROW(tree.add(branch), InvalidInput);
  EXPECT_TRUE(tree.empty());
}

TEST(Children, AreListedInTheOrderTheyAreStored) {
  AirwayTree tree;
  const int root = addBranch(tree, -1, Vec3(0, 0, -1));
  const int a = addBranch(tree, root, Vec3(1, 0, -1));
  const int b = addBranch(tree, root, Vec3(-1, 0, -1));
  const int c = addBranch(tree, a, Vec3(1, 0, -1));
  const Children children(tree);
  EXPECT_THAT(children.of(0), ElementsAre(a, b));
  EXPECT_THAT(children.of(1), ElementsAre(c));
  EXPECT_FALSE(children.isTerminal(1));
  EXPECT_TRUE(children.isTerminal(2));
  EXPECT_TRUE(children.isTerminal(3));
  EXPECT_EQ(terminalCount(tree), 2U);
}

TEST(Children, OfAnEmptyTree) {
  const AirwayTree tree;
  const Children children(tree);
  EXPECT_EQ(terminalCount(tree), 0U);
  EXPECT_TRUE(contractChains(tree).empty());
}

/// root - step - fork of (long chain of three, one terminal).
AirwayTree treeWithChains() {
  AirwayTree tree;
  const int root = addBranch(tree, -1, Vec3(0, 0, -6), 3.0, Lobe::Central);
  const int step = addBranch(tree, root, Vec3(0, 0, -2), 1.0, Lobe::RightUpper);
  const int a = addBranch(tree, step, Vec3(1, 0, 0), 0.9, Lobe::RightUpper);
  addBranch(tree, step, Vec3(-1, 0, 0), 0.8, Lobe::RightUpper);
  const int b = addBranch(tree, a, Vec3(2, 0, 0), 0.6, Lobe::RightUpper);
  addBranch(tree, b, Vec3(0, 3, 0), 0.3, Lobe::RightLower);
  return tree;
}

TEST(ContractChains, JoinsOneDaughterSteps) {
  const AirwayTree joined = contractChains(treeWithChains());
  ASSERT_EQ(joined.size(), 3U);
  EXPECT_EQ(joined[0].parent, -1);
  EXPECT_EQ(joined[1].parent, 0);
  EXPECT_EQ(joined[2].parent, 0);
  EXPECT_TRUE(joined[0].distal.isApprox(Vec3(0, 0, -8)));
  EXPECT_TRUE(joined[1].proximal.isApprox(joined[0].distal));
  EXPECT_TRUE(joined[1].distal.isApprox(Vec3(3, 3, -8)));
}

TEST(ContractChains, KeepsTheWayAndItsLength) {
  const AirwayTree joined = contractChains(treeWithChains());
  ASSERT_EQ(joined.size(), 3U);
  ASSERT_EQ(joined[1].via.size(), 2U);
  EXPECT_TRUE(joined[1].via[0].position.isApprox(Vec3(1, 0, -8)));
  EXPECT_TRUE(joined[1].via[1].position.isApprox(Vec3(3, 0, -8)));
  EXPECT_DOUBLE_EQ(lengthMm(joined[1]), 6.0);
  EXPECT_DOUBLE_EQ(lengthMm(joined[2]), 1.0);
}

TEST(ContractChains, AveragesTheRadiusByLengthAndTakesTheChildsLobe) {
  const AirwayTree joined = contractChains(treeWithChains());
  ASSERT_EQ(joined.size(), 3U);
  EXPECT_DOUBLE_EQ(joined[0].radiusMm, (6.0 * 3.0 + 2.0 * 1.0) / 8.0);
  EXPECT_DOUBLE_EQ(joined[1].radiusMm, (1.0 * 0.9 + 2.0 * 0.6 + 3.0 * 0.3) / 6.0);
  EXPECT_EQ(joined[0].lobe, Lobe::RightUpper);
  EXPECT_EQ(joined[1].lobe, Lobe::RightLower);
}

TEST(ContractChains, AddsWhatIsSuppliedOnTheWay) {
  AirwayTree tree = treeWithChains();
  for (std::size_t i = 0; i < tree.size(); ++i) tree.setSuppliedMl(i, 1.0);
  const AirwayTree joined = contractChains(tree);
  ASSERT_EQ(joined.size(), 3U);
  EXPECT_DOUBLE_EQ(joined[0].suppliedMl, 2.0);
  EXPECT_DOUBLE_EQ(joined[1].suppliedMl, 3.0);
  EXPECT_DOUBLE_EQ(joined[2].suppliedMl, 1.0);
}

TEST(ContractChains, LeavesATreeWithoutChainsAlone) {
  const AirwayTree tree = testing::SymmetricTree{.generations = 4}.tree();
  const AirwayTree joined = contractChains(tree);
  ASSERT_EQ(joined.size(), tree.size());
  for (std::size_t i = 0; i < tree.size(); ++i) {
    EXPECT_EQ(joined[i].parent, tree[i].parent);
    EXPECT_EQ(joined[i].distal, tree[i].distal);
    EXPECT_TRUE(joined[i].via.empty());
  }
}

}  // namespace
}  // namespace pneuma
