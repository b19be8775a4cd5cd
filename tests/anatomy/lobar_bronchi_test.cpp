#include "anatomy/lobar_bronchi.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/central_airways.h"
#include "anatomy/validation.h"
#include "core/error.h"
#include "support/sample_trees.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::addBranch;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Upper and lower lobes of both lungs as balls apart from each other; the right is at negative x.
std::vector<LobeRegion> fourBalls() {
  return {{Lobe::RightUpper, testing::ball(40, Vec3(-90, 0, 60))},
          {Lobe::RightLower, testing::ball(40, Vec3(-90, 0, -60))},
          {Lobe::LeftUpper, testing::ball(40, Vec3(90, 0, 60))},
          {Lobe::LeftLower, testing::ball(40, Vec3(90, 0, -60))}};
}

/// Trachea from above to the carina at z = 20 and a way along a bent centreline into each lower
/// lobe, as found in a CT; the upper lobes have none.
AirwayTree intoLowerLobes() {
  AirwayTree tree;
  Branch trachea;
  trachea.proximal = Vec3(0, 0, 150);
  trachea.distal = Vec3(0, 0, 20);
  trachea.radiusMm = 8.0;
  trachea.lobe = Lobe::Central;
  trachea.origin = Origin::Measured;
  tree.add(trachea);
  for (const double side : {-1.0, 1.0}) {
    Branch branch = trachea;
    branch.parent = 0;
    branch.proximal = trachea.distal;
    branch.via = {{Vec3(side * 40, 0, 0), 6.0}, {Vec3(side * 45, 0, -30), 5.0}};
    branch.distal = Vec3(side * 70, 0, -60);
    branch.radiusMm = 6.0;
    tree.add(branch);
  }
  return tree;
}

double lengthOf(const AirwayTree& tree, Origin origin) {
  double mm = 0.0;
  for (const Branch& branch : tree) mm += branch.origin == origin ? lengthMm(branch) : 0.0;
  return mm;
}

TEST(LedIntoLobes, GivesEveryLobeAnInletAndKeepsWhatWasMeasured) {
  const auto lobes = fourBalls();
  const AirwayTree before = intoLowerLobes();
  LedAirways led = ledIntoLobes(before, lobes);
  EXPECT_THAT(led.lobes, ElementsAre(Lobe::RightUpper, Lobe::LeftUpper));
  EXPECT_THAT(problems(led.airways), IsEmpty());
  EXPECT_EQ(assignLobes(led.airways, lobes).size(), 4U);
  // Both ways divided, and one added from each.
  EXPECT_EQ(led.airways.size(), before.size() + 4);
  EXPECT_NEAR(lengthOf(led.airways, Origin::Measured), lengthOf(before, Origin::Measured), 1e-9);
  EXPECT_EQ(std::ranges::count(led.airways, Origin::Template, &Branch::origin), 2);
}

TEST(LedIntoLobes, LeavesAsFarFromTheCarinaAsAMainBronchusIsLong) {
  const auto lobes = fourBalls();
  const LedAirways led = ledIntoLobes(intoLowerLobes(), lobes);
  const double scale = bronchialScale(lobes);
  for (const Branch& branch : led.airways) {
    if (branch.origin != Origin::Template) continue;
    const Side which = side(branch.lobe);
    EXPECT_EQ(branch.distal.x() < 0.0, which == Side::Right);
    const Branch& above = led.airways[static_cast<std::size_t>(branch.parent)];
    EXPECT_EQ(above.origin, Origin::Measured);
    EXPECT_GE(lengthMm(above), mainBronchusMm(which) * scale - 1e-9);
    EXPECT_NEAR(branch.radiusMm, 6.0 * std::cbrt(0.5), 1e-12);
    EXPECT_NEAR((branch.proximal - above.distal).norm(), 0.0, 1e-12);
    // The way bends at |x| = 40, z = 0, where it comes nearest to the upper lobe's centre.
    EXPECT_NEAR(std::abs(branch.proximal.x()), 40.0, 1.5);
  }
}

TEST(LedIntoLobes, GoesOnFromAnEndThatIsMarkedWithTheLobe) {
  const auto lobes = fourBalls();
  AirwayTree tree = intoLowerLobes();
  Branch bud = tree[1];
  bud.via.clear();
  bud.parent = 0;
  bud.proximal = tree[0].distal;
  bud.distal = Vec3(-30, 0, 40);
  bud.lobe = Lobe::RightUpper;
  tree.add(bud);
  const LedAirways led = ledIntoLobes(tree, lobes);
  const auto found = std::ranges::find_if(led.airways, [](const Branch& b) {
    return b.origin == Origin::Template && b.lobe == Lobe::RightUpper;
  });
  ASSERT_NE(found, led.airways.end());
  EXPECT_EQ(found->proximal, bud.distal);
  EXPECT_EQ(led.airways.size(), tree.size() + 3) << "only the left way is divided";
}

TEST(LedIntoLobes, ALungWithoutAnyAirwayIsServedFromTheCarina) {
  const auto lobes = fourBalls();
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, 20));
  addBranch(tree, 0, Vec3(-80, 0, 40));
  addBranch(tree, 0, Vec3(-80, 0, -80));
  LedAirways led = ledIntoLobes(tree, lobes);
  EXPECT_THAT(led.lobes, ElementsAre(Lobe::LeftUpper, Lobe::LeftLower));
  // The first leaves from the carina and is divided by the second where a main bronchus ends.
  const auto main = std::ranges::find(led.airways, Origin::Template, &Branch::origin);
  ASSERT_NE(main, led.airways.end());
  EXPECT_EQ(main->proximal, tree[0].distal);
  const auto lower = std::ranges::find(led.airways, Lobe::LeftLower, &Branch::lobe);
  ASSERT_NE(lower, led.airways.end());
  EXPECT_EQ(lower->proximal, main->distal);
  EXPECT_GE(lengthMm(*main), mainBronchusMm(Side::Left) * bronchialScale(lobes) - 1e-9);
  EXPECT_EQ(assignLobes(led.airways, lobes).size(), 4U);
}

TEST(LedIntoLobes, NeverGoesOnFromAnEndThatALobeIsGrownFrom) {
  // One airway, straight into the lower lobe: the upper one branches from its side.
  std::vector<LobeRegion> lobes = fourBalls();
  lobes.resize(2);
  AirwayTree tree;
  addBranch(tree, -1, Vec3(-90, 0, -30));
  LedAirways led = ledIntoLobes(tree, lobes);
  EXPECT_THAT(led.lobes, ElementsAre(Lobe::RightUpper));
  EXPECT_EQ(led.airways.size(), 3U);
  EXPECT_EQ(assignLobes(led.airways, lobes).size(), 2U);
}

TEST(LedIntoLobes, LeavesAloneWhatIsWhole) {
  const auto lobes = fourBalls();
  const AirwayTree tree = templateAirways(lobes);
  const LedAirways led = ledIntoLobes(tree, lobes);
  EXPECT_THAT(led.lobes, IsEmpty());
  EXPECT_EQ(led.airways.size(), tree.size());
}

TEST(LedIntoLobes, LeavesAirwaysOfAnotherFrameToBeRefused) {
  const auto lobes = fourBalls();
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0, 0, 9000));
  LedAirways led = ledIntoLobes(tree, lobes);
  EXPECT_THAT(led.lobes, IsEmpty());
  EXPECT_THROW(assignLobes(led.airways, lobes), InvalidInput);
}

TEST(LobarEnd, LiesInsideAndNeverBeyondTheCentre) {
  const auto lobe = testing::ball(10, Vec3(100, 0, 0));
  const Vec3 centre(100, 0, 0);
  EXPECT_NEAR(lobarEnd(*lobe, Vec3::Zero(), centre, 20.0, 3.0).x(), 93.0, 1.0);
  EXPECT_NEAR(lobarEnd(*lobe, Vec3(95, 0, 0), centre, 20.0, 3.0).x(), 99.5, 1.0);
  EXPECT_LE(lobarEnd(*lobe, Vec3(95, 0, 0), centre, 20.0, 3.0).x(), 100.0);
}

}  // namespace
}  // namespace pneuma
