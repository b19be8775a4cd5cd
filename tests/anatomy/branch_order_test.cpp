#include "anatomy/branch_order.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/sample_trees.h"

namespace pneuma {
namespace {

using testing::addBranch;
using ::testing::DoubleEq;
using ::testing::ElementsAre;

/// 0 - 1 - (2 terminal, 3 - (4 terminal, 5 terminal)), with 0 - 1 a one-daughter step.
AirwayTree asymmetricTree() {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -4));
  addBranch(tree, 0, Vec3(0, 0, -2));
  addBranch(tree, 1, Vec3(1, 0, -1));
  addBranch(tree, 1, Vec3(-1, 0, -1));
  addBranch(tree, 3, Vec3(-1, 0, -1));
  addBranch(tree, 3, Vec3(0, 1, -1));
  return tree;
}

TEST(BranchOrder, GenerationsCountFromTheTrachea) {
  EXPECT_THAT(generations(asymmetricTree()), ElementsAre(0, 1, 2, 2, 3, 3));
}

TEST(BranchOrder, HorsfieldIsOneMoreThanTheHighestChild) {
  EXPECT_THAT(horsfieldOrders(asymmetricTree()), ElementsAre(3, 3, 1, 2, 1, 1));
}

TEST(BranchOrder, StrahlerRisesOnlyWhereEqualOrdersMeet) {
  EXPECT_THAT(strahlerOrders(asymmetricTree()), ElementsAre(2, 2, 1, 2, 1, 1));
}

TEST(BranchOrder, StrahlerDoesNotRiseTwiceAtATrifurcation) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  for (const double x : {-1.0, 0.0, 1.0}) addBranch(tree, 0, Vec3(x, 0, -1));
  EXPECT_THAT(strahlerOrders(tree), ElementsAre(2, 1, 1, 1));
  EXPECT_THAT(horsfieldOrders(tree), ElementsAre(2, 1, 1, 1));
}

TEST(BranchOrder, OfASymmetricTreeIsTheHeightAboveTheTerminals) {
  const AirwayTree tree = testing::SymmetricTree{.generations = 5}.tree();
  const std::vector<int> generation = generations(tree);
  const std::vector<int> horsfield = horsfieldOrders(tree);
  EXPECT_EQ(horsfield, strahlerOrders(tree));
  for (std::size_t i = 0; i < tree.size(); ++i) EXPECT_EQ(horsfield[i], 5 - generation[i]);
}

TEST(BranchOrder, OfAnEmptyTreeIsEmpty) {
  EXPECT_TRUE(generations({}).empty());
  EXPECT_TRUE(horsfieldOrders({}).empty());
  EXPECT_TRUE(strahlerOrders({}).empty());
  EXPECT_TRUE(flowFractions({}).empty());
}

TEST(FlowFractions, CountTerminalsWhereNothingIsKnown) {
  const std::vector<double> flow = flowFractions(asymmetricTree());
  EXPECT_THAT(flow, ElementsAre(DoubleEq(1.0), DoubleEq(1.0), DoubleEq(1.0 / 3), DoubleEq(2.0 / 3),
                                DoubleEq(1.0 / 3), DoubleEq(1.0 / 3)));
}

TEST(FlowFractions, AddUpWhatBranchesSupply) {
  AirwayTree tree = asymmetricTree();
  tree.setSuppliedMl(1, 2.0);  // lung supplied by a branch that also has daughters
  tree.setSuppliedMl(2, 1.0);
  tree.setSuppliedMl(4, 3.0);
  tree.setSuppliedMl(5, 4.0);
  const std::vector<double> flow = flowFractions(tree);
  EXPECT_THAT(flow, ElementsAre(DoubleEq(1.0), DoubleEq(1.0), DoubleEq(0.1), DoubleEq(0.7),
                                DoubleEq(0.3), DoubleEq(0.4)));
}

TEST(FlowFractions, HalveAtEveryForkOfASymmetricTree) {
  const AirwayTree tree = testing::SymmetricTree{.generations = 6}.tree();
  const std::vector<int> generation = generations(tree);
  const std::vector<double> flow = flowFractions(tree);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    EXPECT_DOUBLE_EQ(flow[i], std::pow(0.5, generation[i]));
  }
}

}  // namespace
}  // namespace pneuma
