#include "growth/airway_seeds.h"

#include <gtest/gtest.h>

#include "support/sample_trees.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::addBranch;
using testing::box;

/// Trachea 40 mm down to z = 60, main bronchus to z = 20, lobar one to z = 0.
AirwayTree straightDown() {
  AirwayTree tree;
  for (const double end : {60.0, 20.0, 0.0}) {
    Branch branch;
    branch.parent = static_cast<int>(tree.size()) - 1;
    branch.proximal = tree.empty() ? Vec3(0, 0, 100) : tree[tree.size() - 1].distal;
    branch.distal = Vec3(0, 0, end);
    branch.origin = Origin::Template;
    tree.add(branch);
  }
  return tree;
}

TEST(AirwaySeeds, GoBackFromTheEndAsLongAsTheyAreInside) {
  const AirwayTree tree = straightDown();
  const auto lobe = box({-30, -30, -50}, {30, 30, 35.2});
  const std::size_t inlet = 2;
  const auto seeds = airwaySeeds(tree, {&inlet, 1}, *lobe, 1.0);
  ASSERT_FALSE(seeds.empty());
  EXPECT_EQ(seeds.front().point, tree[2].distal);
  double highest = -1e9;
  for (std::size_t i = 1; i < seeds.size(); ++i) {
    EXPECT_TRUE(lobe->contains(seeds[i].point));
    EXPECT_LE((seeds[i].point - seeds[i - 1].point).norm(), 1.0 + 1e-9);
    highest = std::max(highest, seeds[i].point.z());
  }
  EXPECT_NEAR(highest, 35.0, 1e-9);
}

TEST(AirwaySeeds, StartAtTheNearerEndThatIsInside) {
  const AirwayTree tree = straightDown();
  const auto lobe = box({-30, -30, -50}, {30, 30, 35.2});
  const std::size_t inlet = 2;
  for (const AirwaySeed& seed : airwaySeeds(tree, {&inlet, 1}, *lobe, 1.0)) {
    const double z = seed.point.z();
    // The main bronchus leaves the lobe: its upper end is no place to start from.
    const int expected = z < 10.0 + 1e-9 ? 2 : 1;
    EXPECT_EQ(seed.parent, expected) << z;
  }
}

TEST(AirwaySeeds, FollowTheCentrelineOfABentAirway) {
  AirwayTree tree;
  Branch bent;
  bent.proximal = {0, 0, 30};
  bent.via = {{{20, 0, 10}, 2.0}};
  bent.distal = {0, 0, 0};
  tree.add(bent);
  const std::size_t inlet = 0;
  const auto lobe = box({-30, -30, -50}, {30, 30, 50});
  const auto seeds = airwaySeeds(tree, {&inlet, 1}, *lobe, 0.5);
  bool beyond = false;
  for (const AirwaySeed& seed : seeds) {
    EXPECT_EQ(seed.parent, 0) << "a root has no other end to start from";
    if (seed.point.z() <= 10.0 + 1e-9) continue;
    beyond = true;
    ASSERT_EQ(seed.way.size(), 1U);
    EXPECT_EQ(seed.way.front(), bent.via.front().position);
  }
  EXPECT_TRUE(beyond);
}

}  // namespace
}  // namespace pneuma
