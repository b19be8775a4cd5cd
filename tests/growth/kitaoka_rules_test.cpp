#include "growth/kitaoka_rules.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

double degreesOf(const Turn& turn) { return turn.degrees(); }

TEST(KitaokaRules, Rule6GivesThePapersAnglesOfASmallDaughter) {
  // "for r = 0.01, the smaller angle is 78 and 80 degrees for n = 2.8 and n = 3" (rule 6a)
  EXPECT_NEAR(degreesOf(rule6BranchingAngles(0.01, 2.8).a), 78.0, 0.6);
  EXPECT_NEAR(degreesOf(rule6BranchingAngles(0.01, 3.0).a), 80.0, 0.6);
}

TEST(KitaokaRules, Rule6MinimisesTheVolumeOfABifurcation) {
  // Eq. 5: d0^2 / sin(a + b) = d_a^2 / sin(a) with the roles of Kamiya exchanged: the larger
  // daughter has the smaller angle, and both meet the balance d0^2 = d_a^2 cos a + d_b^2 cos b,
  // d_a^2 sin a = d_b^2 sin b.
  for (const double share : {0.05, 0.2, 0.35, 0.5}) {
    const BranchingAngles angles = rule6BranchingAngles(share, 2.8);
    const double a = std::pow(share, 2.0 / 2.8);
    const double b = std::pow(1.0 - share, 2.0 / 2.8);
    EXPECT_NEAR(a * angles.a.cosine + b * angles.b.cosine, 1.0, 1e-9) << share;
    EXPECT_NEAR(a * angles.a.sine, b * angles.b.sine, 1e-9) << share;
  }
}

TEST(KitaokaRules, Rule6IsTheSameForBothDaughtersOfAnEvenDivision) {
  const BranchingAngles angles = rule6BranchingAngles(0.5, 2.8);
  EXPECT_DOUBLE_EQ(angles.a.cosine, angles.b.cosine);
  // 2^(2/n) / 2
  EXPECT_NEAR(angles.a.cosine, std::pow(2.0, 2.0 / 2.8) / 2.0, 1e-9);
}

TEST(KitaokaRules, Rule6LeavesADaughterWithoutFlowAtARightAngle) {
  const BranchingAngles angles = rule6BranchingAngles(0.0, 2.8);
  EXPECT_DOUBLE_EQ(angles.a.cosine, 0.0);
  EXPECT_DOUBLE_EQ(angles.b.cosine, 1.0);
}

TEST(KitaokaRules, DiametersConserveFlow) {
  const double a = rule6Diameter(0.3, 18.0, 2.8);
  const double b = rule6Diameter(0.7, 18.0, 2.8);
  EXPECT_NEAR(std::pow(a, 2.8) + std::pow(b, 2.8), std::pow(18.0, 2.8), 1e-6);  // Eq. 3
}

TEST(KitaokaRules, Rule4aAppliesFromTenDegrees) {
  const auto angles = [](double a, double b) {
    return BranchingAngles{Turn::ofDegrees(a), Turn::ofDegrees(b)};
  };
  EXPECT_FALSE(rule4aApplies(angles(44.9, 35.0)));
  EXPECT_TRUE(rule4aApplies(angles(45.1, 35.0)));
  EXPECT_TRUE(rule4aApplies(angles(35.0, 45.1)));
}

TEST(KitaokaRules, Rule4aBendsAlongTheBisectorTowardsTheLargerAngle) {
  EXPECT_NEAR(degreesOf(rule4aBend({Turn::ofDegrees(70.0), Turn::ofDegrees(20.0)})), 25.0, 1e-9);
  EXPECT_NEAR(degreesOf(rule4aBend({Turn::ofDegrees(20.0), Turn::ofDegrees(70.0)})), -25.0, 1e-9);
}

TEST(KitaokaRules, Rule6aTakesTheMeanAndStopsAtNinetyDegrees) {
  const auto corrected = [](double angle, double bisecting) {
    return degreesOf(rule6aCorrected(Turn::ofDegrees(angle), Turn::ofDegrees(bisecting)));
  };
  EXPECT_NEAR(corrected(40.0, 60.0), 50.0, 1e-9);
  EXPECT_NEAR(corrected(40.0, 30.0), 40.0, 1e-9);  // only ever enlarged
  EXPECT_NEAR(corrected(70.0, 120.0), 90.0, 1e-9);
}

TEST(KitaokaRules, Rule7aBringsTheDistanceBetweenItsLimits) {
  const KitaokaOptions options;
  const auto ratio = [&](double distance) {
    return rule7aLengthToDiameter(3.0, distance, 1.0, options);
  };
  EXPECT_DOUBLE_EQ(ratio(12.0), 3.0);   // 4 lengths: as it was
  EXPECT_DOUBLE_EQ(ratio(8.0), 2.5);    // 2.67 lengths; 8 / 2.5 = 3.2
  EXPECT_DOUBLE_EQ(ratio(19.0), 3.25);  // 6.33 lengths; 19 / 3.25 = 5.8
  EXPECT_DOUBLE_EQ(ratio(0.0), 1.0);    // never below 1
}

TEST(KitaokaRules, Rule8TurnsTheBranchingPlaneByARightAngle) {
  const Vec3 u = Vec3::UnitZ();
  const Vec3 b = Vec3::UnitX();
  EXPECT_TRUE(rule8InPlane(u, b, Turn::ofDegrees(90.0)).isApprox(b, 1e-9));
  const Vec3 turned = rule8InPlane(u, b, Turn::ofDegrees(45.0));
  EXPECT_NEAR(turned.norm(), 1.0, 1e-9);
  EXPECT_NEAR(turned.dot(u), 0.0, 1e-9);
  EXPECT_NEAR(turned.dot(b), std::sqrt(0.5), 1e-9);
}

}  // namespace
}  // namespace pneuma
