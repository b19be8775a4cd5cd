#include "anatomy/diameter_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "anatomy/branch_order.h"
#include "support/sample_trees.h"

namespace pneuma {
namespace {

using testing::SymmetricTree;

TEST(WeibelDiameter, FollowsTheTableAndStopsAtItsEnds) {
  EXPECT_DOUBLE_EQ(weibelDiameterMm(0), 18.0);
  EXPECT_DOUBLE_EQ(weibelDiameterMm(16), 0.6);
  EXPECT_DOUBLE_EQ(weibelDiameterMm(23), 0.41);
  EXPECT_DOUBLE_EQ(weibelDiameterMm(40), 0.41);
  EXPECT_DOUBLE_EQ(weibelDiameterMm(-3), 18.0);
}

TEST(AssignDiameters, WeibelsTableBelowATracheaOfItsSize) {
  AirwayTree tree = SymmetricTree{.generations = 8}.tree();
  tree.setOrigin(0, Origin::Measured);
  tree.setRadiusMm(0, 9.0);
  assignDiameters(tree, DiameterLaw::Weibel, 3.0);
  const std::vector<int> generation = generations(tree);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    EXPECT_NEAR(2.0 * tree[i].radiusMm, weibelDiameterMm(generation[i]), 1e-12);
  }
}

TEST(AssignDiameters, WeibelsTableIsScaledToTheMeasuredInlet) {
  AirwayTree tree = SymmetricTree{.generations = 6}.tree();
  tree.setOrigin(0, Origin::Measured);
  tree.setRadiusMm(0, 4.5);  // half of Weibel's trachea
  assignDiameters(tree, DiameterLaw::Weibel, 3.0);
  EXPECT_DOUBLE_EQ(tree[0].radiusMm, 4.5);
  EXPECT_NEAR(2.0 * tree[1].radiusMm, 12.2 / 2.0, 1e-12);
}

TEST(AssignDiameters, FlowLawKeepsMurraysSum) {
  AirwayTree tree = SymmetricTree{.generations = 5}.tree();
  tree.setOrigin(0, Origin::Template);
  tree.setRadiusMm(0, 8.0);
  assignDiameters(tree, DiameterLaw::Flow, 3.0);
  const Children children(tree);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (children.isTerminal(i)) continue;
    double cubes = 0.0;
    for (const int id : children.of(i)) {
      cubes += std::pow(tree[static_cast<std::size_t>(id)].radiusMm, 3);
    }
    EXPECT_NEAR(cubes, std::pow(tree[i].radiusMm, 3), 1e-9);
  }
}

TEST(AssignDiameters, FlowLawUsesTheExponent) {
  AirwayTree tree = SymmetricTree{.generations = 2}.tree();
  tree.setOrigin(0, Origin::Measured);
  tree.setRadiusMm(0, 5.0);
  assignDiameters(tree, DiameterLaw::Flow, 2.8);
  EXPECT_NEAR(tree[1].radiusMm, 5.0 * std::pow(0.5, 1.0 / 2.8), 1e-12);
}

TEST(AssignDiameters, NoBranchIsWiderThanItsParent) {
  AirwayTree tree = SymmetricTree{.generations = 9}.tree();
  tree.setOrigin(0, Origin::Measured);
  tree.setOrigin(1, Origin::Measured);
  tree.setRadiusMm(0, 9.0);
  tree.setRadiusMm(1, 0.2);
  for (const DiameterLaw law : {DiameterLaw::Weibel, DiameterLaw::Flow}) {
    assignDiameters(tree, law, 3.0);
    for (std::size_t i = 2; i < tree.size(); ++i) {
      EXPECT_LE(tree[i].radiusMm, tree[static_cast<std::size_t>(tree[i].parent)].radiusMm);
      EXPECT_GT(tree[i].radiusMm, 0.0);
    }
    EXPECT_DOUBLE_EQ(tree[1].radiusMm, 0.2);  // measured branches keep theirs
  }
}

}  // namespace
}  // namespace pneuma
