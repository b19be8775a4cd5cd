#include "anatomy/order_ratios.h"

#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/branch_order.h"
#include "support/sample_trees.h"

namespace pneuma {
namespace {

using testing::addBranch;
using ::testing::ElementsAre;
using testing::SymmetricTree;

std::vector<std::size_t> allBranches(const AirwayTree& tree) {
  std::vector<std::size_t> ids(tree.size());
  std::iota(ids.begin(), ids.end(), std::size_t{0});
  return ids;
}

TEST(OrderRatios, OfASymmetricTreeAreThoseItWasBuiltWith) {
  const AirwayTree tree = SymmetricTree{
      .generations = 7,
      .lengthMm = [](int z) { return 40.0 * std::pow(1.3, -z); },
      .diameterMm = [](int z) { return 12.0 * std::pow(1.25, -z); },
  }
                              .tree();
  for (const std::vector<int>& orders : {strahlerOrders(tree), horsfieldOrders(tree)}) {
    const OrderRatios ratios = orderRatios(tree, orders, allBranches(tree));
    EXPECT_THAT(ratios.counts, ElementsAre(64, 32, 16, 8, 4, 2, 1));
    EXPECT_NEAR(ratios.branching.ratio, 2.0, 1e-12);
    EXPECT_NEAR(ratios.length.ratio, 1.3, 1e-12);
    EXPECT_NEAR(ratios.diameter.ratio, 1.25, 1e-12);
    EXPECT_NEAR(ratios.branching.r2, 1.0, 1e-12);
    EXPECT_NEAR(ratios.length.r2, 1.0, 1e-12);
    EXPECT_NEAR(ratios.diameter.r2, 1.0, 1e-12);
  }
}

/// A trunk from which single terminals part, one after the other: four terminals.
AirwayTree comb() {
  AirwayTree tree;
  int last = addBranch(tree, -1, Vec3(0, 0, -8), 4.0);
  for (int i = 0; i < 3; ++i) {
    addBranch(tree, last, Vec3(2, 0, 0), 1.0);
    last = addBranch(tree, last, i < 2 ? Vec3(0, 0, -4) : Vec3(0, 0, -2), i < 2 ? 2.0 : 1.0);
  }
  return tree;
}

TEST(OrderRatios, BranchesOfOneStrahlerOrderInARowAreOneElement) {
  const AirwayTree tree = comb();
  const OrderRatios ratios = orderRatios(tree, strahlerOrders(tree), allBranches(tree));
  // Four terminals of 2 mm; one trunk of 8 + 4 + 4 mm, 6 mm wide on average.
  EXPECT_THAT(ratios.counts, ElementsAre(4, 1));
  EXPECT_NEAR(ratios.branching.ratio, 4.0, 1e-12);
  EXPECT_NEAR(ratios.length.ratio, 16.0 / 2.0, 1e-12);
  EXPECT_NEAR(ratios.diameter.ratio, (8.0 * 8.0 + 8.0 * 4.0) / 16.0 / 2.0, 1e-12);
}

TEST(OrderRatios, HorsfieldOrdersOfACombRiseAtEveryFork) {
  const AirwayTree tree = comb();
  const OrderRatios ratios = orderRatios(tree, horsfieldOrders(tree), allBranches(tree));
  EXPECT_THAT(ratios.counts, ElementsAre(4, 1, 1, 1));
  // Slope of (ln 4, 0, 0, 0) against 1..4 by hand: -0.3 ln 4; R2 = (0.3 ln 4)^2 * 5 / (0.75 ln^2
  // 4).
  EXPECT_NEAR(ratios.branching.ratio, std::pow(4.0, 0.3), 1e-12);
  EXPECT_NEAR(ratios.branching.r2, 0.6, 1e-12);
}

TEST(OrderRatios, OfAPartLeaveOutOrdersThatAreMissingThere) {
  const AirwayTree tree = SymmetricTree{.generations = 5}.tree();
  const std::vector<std::size_t> trunk = {0, 1, 2};  // orders 5, 4, 4
  const OrderRatios ratios = orderRatios(tree, strahlerOrders(tree), trunk);
  EXPECT_THAT(ratios.counts, ElementsAre(0, 0, 0, 2, 1));
  EXPECT_NEAR(ratios.branching.ratio, 2.0, 1e-12);
}

TEST(OrderRatios, OfOneOrderAreUnknown) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, -1));
  const OrderRatios ratios = orderRatios(tree, strahlerOrders(tree), allBranches(tree));
  EXPECT_THAT(ratios.counts, ElementsAre(1));
  EXPECT_EQ(ratios.branching.ratio, 0.0);
}

}  // namespace
}  // namespace pneuma
