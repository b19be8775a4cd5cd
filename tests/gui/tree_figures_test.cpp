#include "document/tree_figures.h"

#include <gtest/gtest.h>

#include "sample_snapshot.h"

namespace pneuma {
namespace {

TEST(TreeFigures, CountsBranchesPerGenerationAndLobe) {
  const AirwayTree tree = testing::SymmetricTree{.generations = 5}.tree();
  const TreeFigures figures = treeFigures(tree);
  EXPECT_EQ(figures.branchesOfGeneration, (std::vector<std::size_t>{1, 2, 4, 8, 16}));
  EXPECT_EQ(figures.terminals, 16U);
  EXPECT_EQ(figures.terminalsIn.at(Lobe::Whole), 16U);
  EXPECT_EQ(figures.branchesIn.at(Lobe::Whole), 31U);
  EXPECT_DOUBLE_EQ(figures.pathMm.back(), 50.0);
}

TEST(TreeFigures, WalkingFindsKin) {
  const AirwayTree tree = testing::threeBranches();
  EXPECT_EQ(neighbour(tree, 1, Neighbour::Parent), 0U);
  EXPECT_EQ(neighbour(tree, 0, Neighbour::Parent), 0U);
  EXPECT_EQ(neighbour(tree, 0, Neighbour::Child), 2U);  // the wider one
  EXPECT_EQ(neighbour(tree, 1, Neighbour::Child), 1U);
  EXPECT_EQ(neighbour(tree, 1, Neighbour::NextSibling), 2U);
  EXPECT_EQ(neighbour(tree, 2, Neighbour::NextSibling), 1U);
  EXPECT_EQ(neighbour(tree, 1, Neighbour::PreviousSibling), 2U);
}

}  // namespace
}  // namespace pneuma
