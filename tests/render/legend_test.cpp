#include "render/legend.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

std::vector<std::string> labelsOf(const Legend& legend) {
  std::vector<std::string> result;
  for (const Legend::Tick& tick : legend.ticks) result.push_back(tick.label);
  return result;
}

using Labels = std::vector<std::string>;

TEST(Legend, DiameterTicksAreRoundAndLogarithmic) {
  const Scale scale(Scale::Kind::LogarithmicMm, 0.4, 18.0);
  const Legend legend = scale.legend("Diameter, mm", Background::Dark);
  EXPECT_EQ(labelsOf(legend), (Labels{"0.5", "1", "2", "5", "10"}));
  EXPECT_NEAR(legend.ticks[1].position - legend.ticks[0].position,
              legend.ticks[2].position - legend.ticks[1].position, 1e-9);
}

TEST(Legend, FlowTicksAreDecadesInPercent) {
  const Scale scale(Scale::Kind::LogarithmicShare, 3e-5, 1.0);
  EXPECT_EQ(labelsOf(scale.legend("Share of flow", Background::Dark)),
            (Labels{"0.01 %", "0.1 %", "1 %", "10 %", "100 %"}));
  EXPECT_DOUBLE_EQ(scale.position(1.0), 1.0);
}

TEST(Legend, CountsHaveWholeTicksAndNotTooMany) {
  EXPECT_EQ(labelsOf(Scale(Scale::Kind::Count, 1, 4).legend("", Background::Dark)),
            (Labels{"1", "2", "3", "4"}));
  EXPECT_EQ(labelsOf(Scale(Scale::Kind::Count, 0, 23).legend("", Background::Dark)),
            (Labels{"0", "5", "10", "15", "20"}));
}

TEST(Legend, ScaleOfOneValueStillHasATick) {
  EXPECT_EQ(labelsOf(Scale(Scale::Kind::Count, 2, 2).legend("", Background::Dark)), (Labels{"2"}));
}

TEST(Legend, LobesComeInAnatomicalOrderWithTheirNames) {
  const Legend legend = lobeLegend({Lobe::LeftLower, Lobe::RightUpper, Lobe::Central},
                                   Palette::Pneuma, Background::Dark);
  ASSERT_EQ(legend.chips.size(), 3U);
  EXPECT_EQ(legend.chips[0].label, "Right upper lobe");
  EXPECT_EQ(legend.chips[0].brief, "RUL");
  EXPECT_EQ(legend.chips[2].label, "Central airways");
}

TEST(Legend, ScaleBarIsTheLongestRoundLengthThatFits) {
  EXPECT_DOUBLE_EQ(scaleBarMm(1.0, 120.0), 100.0);
  EXPECT_DOUBLE_EQ(scaleBarMm(1.0, 99.0), 50.0);
  EXPECT_DOUBLE_EQ(scaleBarMm(2.0, 99.0), 20.0);
  EXPECT_NEAR(scaleBarMm(1000.0, 60.0), 0.05, 1e-12);
  EXPECT_DOUBLE_EQ(scaleBarMm(1.0, -5.0), 0.0);
}

}  // namespace
}  // namespace pneuma
