#include "growth/predefined_growth.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/segment.h"
#include "core/error.h"
#include "core/units.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::box;
using ::testing::HasSubstr;

PredefinedAirways oneBifurcation() {
  PredefinedAirways table;
  table.root = "TRACHEA";
  table.start = {0, 0, 50};
  table.direction = -Vec3::UnitZ();
  table.diameterMm = 10.0;
  table.lengthMm = 50.0;
  table.bifurcations = {{"TRACHEA", {"RB1", 40.0, 2.0}, {"LB10", 40.0, 3.0}, -Vec3::UnitX(), 0.0}};
  return table;
}

const LobeRegion Organ = {Lobe::Whole, box({-60, -40, -100}, {60, 40, 20})};

TEST(PredefinedGrowth, FollowsItsTable) {
  const AirwayTree tree = growPredefined(oneBifurcation(), Organ, kitaokaPaper());
  ASSERT_EQ(tree.size(), 3U);
  const double half = 10.0 * std::pow(0.5, 1.0 / 2.8);  // the organ is symmetric about the trunk
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(tree[i].parent, 0);
    EXPECT_EQ(tree[i].origin, Origin::Template);
    EXPECT_NEAR(2.0 * tree[i].radiusMm, half, 0.02 * half);
    EXPECT_NEAR(degrees(angleBetween(direction(tree[i]), -Vec3::UnitZ())), 40.0, 1e-6);
  }
  EXPECT_LT(tree[1].distal.x(), 0.0);  // a goes where the hint points
  EXPECT_GT(tree[2].distal.x(), 0.0);
  EXPECT_NEAR(lengthMm(tree[1]), 2.0 * 2.0 * tree[1].radiusMm, 1e-9);
  EXPECT_NEAR(lengthMm(tree[2]), 3.0 * 2.0 * tree[2].radiusMm, 1e-9);
  EXPECT_EQ(segmentName(tree[1].segment), "RB1");
  EXPECT_EQ(segmentName(tree[2].segment), "LB10");
}

TEST(PredefinedGrowth, TurnsTheHintByTheAzimuth) {
  PredefinedAirways table = oneBifurcation();
  table.bifurcations[0].azimuthDeg = 90.0;
  const AirwayTree tree = growPredefined(table, Organ, kitaokaPaper());
  // Right-handed about the trunk, which points down: -x becomes u x (-x) = y.
  EXPECT_NEAR(tree[1].distal.x(), 0.0, 1e-9);
  EXPECT_GT(tree[1].distal.y(), 0.0);
}

TEST(PredefinedGrowth, NamesWhatItCannotDivide) {
  PredefinedAirways table = oneBifurcation();
  table.bifurcations[0].parent = "RMB";
  try {
    growPredefined(table, Organ, kitaokaPaper());
    FAIL() << "divided a branch that is not there";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("'RMB'"));
  }
}

TEST(PredefinedGrowth, NamesADaughterWithoutRoom) {
  PredefinedAirways table = oneBifurcation();
  table.start = {-200, 0, 50};  // everything lies to the left of the trunk
  try {
    growPredefined(table, Organ, kitaokaPaper());
    FAIL() << "gave room to both";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("'RB1'"));
  }
}

}  // namespace
}  // namespace pneuma
