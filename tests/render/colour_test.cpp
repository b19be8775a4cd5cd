#include "render/colour.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "anatomy/segment.h"
#include "render/branch_colours.h"
#include "render/colour_map.h"
#include "render/generated_lungs.h"

namespace pneuma {
namespace {

double distance(const Rgb& a, const Rgb& b) {
  const Lab p = labOf(a);
  const Lab q = labOf(b);
  return std::hypot(p.l - q.l, p.a - q.a, p.b - q.b);
}

/// What somebody without green cones sees (Vienot 1999, on linear RGB).
Rgb asDeuteranope(const Rgb& c) {
  const auto linear = [](double s) { return std::pow(s, 2.2); };
  const auto coded = [](double l) { return std::pow(std::max(l, 0.0), 1.0 / 2.2); };
  const double r = linear(c.r);
  const double g = linear(c.g);
  const double b = linear(c.b);
  const double yellow = 0.29275 * r + 0.70725 * g;
  return {coded(yellow), coded(yellow), coded(-0.02234 * r + 0.02234 * g + b)};
}

TEST(Colour, LabOfKnownColours) {
  const Lab white = labOf({1, 1, 1});
  EXPECT_NEAR(white.l, 100.0, 0.01);
  EXPECT_NEAR(white.a, 0.0, 0.02);
  const Lab red = labOf({1, 0, 0});
  EXPECT_NEAR(red.l, 53.24, 0.02);
  EXPECT_NEAR(red.a, 80.09, 0.05);
  EXPECT_NEAR(red.b, 67.20, 0.05);
}

TEST(Colour, SurvivesTheWayThroughLab) {
  for (const Rgb& colour : {Rgb{0.2, 0.4, 0.9}, Rgb{0.0, 0.01, 0.02}, Rgb{1, 0.5, 0}}) {
    EXPECT_LT(distance(rgbOf(labOf(colour)), colour), 0.01);
  }
}

TEST(ColourMap, ScaleGetsLighterAllTheWayAlsoForTheColourBlind) {
  for (int i = 1; i <= 100; ++i) {
    const Rgb before = scaleColour((i - 1) / 100.0);
    const Rgb after = scaleColour(i / 100.0);
    EXPECT_GT(labOf(after).l, labOf(before).l + 0.1) << i;
    EXPECT_GT(labOf(asDeuteranope(after)).l, labOf(asDeuteranope(before)).l) << i;
  }
}

TEST(ColourMap, LobesAreToldApartAlsoByTheColourBlind) {
  for (const Lobe a : FiveLobes) {
    for (const Lobe b : FiveLobes) {
      if (a >= b) continue;
      const Rgb p = lobeColour(a, Palette::Pneuma);
      const Rgb q = lobeColour(b, Palette::Pneuma);
      EXPECT_GT(distance(p, q), 25.0);
      // Three times what is just noticeable: the closest pair is RUL and LLL.
      EXPECT_GT(distance(asDeuteranope(p), asDeuteranope(q)), 6.0)
          << shortName(a) << " " << shortName(b);
    }
  }
}

TEST(ColourMap, LungsAreToldApartByLightnessAloneAndFromTheirLobes) {
  const Rgb right = lobeColour(Lobe::RightLung, Palette::Pneuma);
  const Rgb left = lobeColour(Lobe::LeftLung, Palette::Pneuma);
  EXPECT_GT(labOf(left).l - labOf(right).l, 20.0);
  EXPECT_GT(labOf(asDeuteranope(left)).l - labOf(asDeuteranope(right)).l, 20.0);
  for (const Lobe lobe : FiveLobes) {
    EXPECT_GT(distance(lobeColour(lobe, Palette::Pneuma), right), 15.0) << shortName(lobe);
    EXPECT_GT(distance(lobeColour(lobe, Palette::Pneuma), left), 15.0) << shortName(lobe);
  }
}

TEST(ColourMap, HuangPaletteIsRedGreenBlueFromAbove) {
  const Rgb upper = lobeColour(Lobe::LeftUpper, Palette::Huang);
  const Rgb middle = lobeColour(Lobe::RightMiddle, Palette::Huang);
  const Rgb lower = lobeColour(Lobe::RightLower, Palette::Huang);
  EXPECT_TRUE(upper.r > upper.g && upper.r > upper.b);
  EXPECT_TRUE(middle.g > middle.r && middle.g > middle.b);
  EXPECT_TRUE(lower.b > lower.r && lower.b > lower.g);
  EXPECT_EQ(upper, lobeColour(Lobe::RightUpper, Palette::Huang));
}

TEST(ColourMap, EighteenSegmentsHaveEighteenColours) {
  std::vector<Rgb> colours = {segmentColour(0)};
  for (const Segment& segment : segments()) colours.push_back(segmentColour(segment.number));
  for (std::size_t i = 0; i < colours.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT(distance(colours[i], colours[k]), 12.0) << i << " " << k;
    }
  }
}

TEST(BranchColours, SegmentsAreNamedInTheirOrder) {
  AirwayTree tree;
  for (const std::uint8_t segment : {0, 20, 11, 10, 2, 17}) {
    Branch branch;
    branch.parent = tree.empty() ? -1 : 0;
    branch.distal = Vec3(0.0, 0.0, -1.0);
    branch.segment = segment;
    tree.add(branch);
  }
  const BranchColours coloured =
      branchColours(tree, std::vector<bool>(tree.size(), true), {.colourBy = ColourBy::Segment});
  std::vector<std::string> labels;
  for (const Legend::Chip& chip : coloured.legend.chips) labels.push_back(chip.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"RB2", "RB10", "LB1+2", "17", "LB10", "none"}));
  EXPECT_EQ(coloured.colours[1], segmentColour(20));
}

TEST(BranchColours, ScaleSpansTheVisibleBranches) {
  const auto tree = test::generatedTree();
  const std::vector<bool> visible = branchesUpTo(*tree, 3);
  const BranchColours coloured =
      branchColours(*tree, visible, {.colourBy = ColourBy::Generation, .maxGeneration = 3});
  ASSERT_EQ(coloured.colours.size(), tree->size());
  EXPECT_EQ(coloured.colours[0], scaleColour(0.0));
  EXPECT_EQ(coloured.legend.ticks.front().label, "0");
  EXPECT_EQ(coloured.legend.ticks.back().label, "3");
}

TEST(BranchColours, ScaleSpansThePeersToo) {
  const auto small = test::generatedTree(4);
  const std::vector<std::shared_ptr<const AirwayTree>> peers = {small, test::generatedTree(7)};
  const SceneOptions options = {.colourBy = ColourBy::Generation};
  const std::vector<bool> all(small->size(), true);
  const BranchColours alone = branchColours(*small, all, options);
  const BranchColours beside = branchColours(*small, all, options, peers);
  const std::vector<bool> allOfPeer(peers[1]->size(), true);
  const BranchColours ofPeer = branchColours(*peers[1], allOfPeer, options, peers);
  EXPECT_EQ(beside.legend.ticks.back().label, ofPeer.legend.ticks.back().label);
  EXPECT_NE(beside.legend.ticks.back().label, alone.legend.ticks.back().label);
  EXPECT_EQ(alone.colours.back(), scaleColour(1.0));
  EXPECT_NE(beside.colours.back(), scaleColour(1.0));
}

TEST(BranchColours, SegmentsOfPeersStandInTheLegend) {
  AirwayTree tree;
  tree.add({.parent = -1, .distal = Vec3::UnitZ(), .radiusMm = 1.0, .segment = 2});
  AirwayTree other;
  other.add({.parent = -1, .distal = Vec3::UnitZ(), .radiusMm = 1.0, .segment = 20});
  const std::vector<std::shared_ptr<const AirwayTree>> peers = {
      std::make_shared<const AirwayTree>(other)};
  const Legend legend = branchColours(tree, {true}, {.colourBy = ColourBy::Segment}, peers).legend;
  ASSERT_EQ(legend.chips.size(), 2U);
  EXPECT_EQ(legend.chips[0].label, "RB2");
  EXPECT_EQ(legend.chips[1].label, "LB10");
}

TEST(BranchColours, BranchWithoutDiameterIsNoTrouble) {
  AirwayTree tree;
  tree.add({.parent = -1, .proximal = Vec3::Zero(), .distal = Vec3::UnitZ(), .radiusMm = 0.0});
  const BranchColours coloured = branchColours(tree, {true}, {.colourBy = ColourBy::Diameter});
  EXPECT_EQ(coloured.colours[0], scaleColour(0.0));
}

}  // namespace
}  // namespace pneuma
