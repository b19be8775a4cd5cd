#include "render/chart.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pneuma {
namespace {

using ::testing::ElementsAre;

TEST(ChartTicks, AreRoundAndHoldTheValues) {
  EXPECT_THAT(chartTicks(0.0, 5.0), ElementsAre(0.0, 1.0, 2.0, 3.0, 4.0, 5.0));
  EXPECT_THAT(chartTicks(3.0, 497.0), ElementsAre(0.0, 100.0, 200.0, 300.0, 400.0, 500.0));
  EXPECT_THAT(chartTicks(-2.0, 2.9), ElementsAre(-2.0, -1.0, 0.0, 1.0, 2.0, 3.0));
  for (const auto& [low, high] :
       {std::pair(0.0, 0.0), std::pair(7.0, 7.0), std::pair(1e-9, 3e-9), std::pair(-1e6, 1.0)}) {
    const std::vector<double> ticks = chartTicks(low, high);
    EXPECT_LE(ticks.front(), low);
    EXPECT_GE(ticks.back(), high);
    EXPECT_GE(ticks.size(), 2U);
    EXPECT_LE(ticks.size(), 9U);
  }
}

/// How many pixels are nearly this colour.
int count(const Picture& picture, int left, int right, int red) {
  int found = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = left; x < right; ++x) {
      const std::size_t at = static_cast<std::size_t>(y * picture.width + x) * 3;
      if (picture.rgb[at] == red && picture.rgb[at + 1] == 0 && picture.rgb[at + 2] == 0) ++found;
    }
  }
  return found;
}

TEST(ChartPicture, DrawsACurveFromEndToEnd) {
  Chart chart{"A line", "x, s", "y, ml", {{"", {}, {}, {200.0 / 255.0, 0.0, 0.0}}}};
  for (int n = 0; n <= 100; ++n) {
    chart.curves[0].x.push_back(n);
    chart.curves[0].y.push_back(n == 50 ? std::nan("") : 3.0 * n);
  }
  const Picture picture = chartPicture(chart, 400, 300);
  EXPECT_EQ(picture.width, 400);
  const int all = count(picture, 0, 400, 200);
  EXPECT_GT(all, 300);
  EXPECT_NEAR(count(picture, 0, 212, 200), all / 2, all / 10);
  chart.curves[0].as = ChartCurve::As::Dots;
  EXPECT_GT(count(chartPicture(chart, 400, 300), 0, 400, 200), all);
}

TEST(ChartPicture, KeepsTheNamesOfCurvesOffALongTitle) {
  const Rgb colour = {200.0 / 255.0, 0.0, 0.0};
  Chart chart{"A title that takes most of the width of its chart",
              "x",
              "y",
              {{"one curve", {0, 1}, {0, 1}, colour}, {"another curve", {0, 1}, {1, 0}, colour}}};
  const Picture named = chartPicture(chart, 400, 300);
  for (ChartCurve& curve : chart.curves) curve.name.clear();
  const Picture plain = chartPicture(chart, 400, 300);
  const auto title = named.rgb.begin() + 400 * 3 * 20;  // its line, with what hangs below it
  EXPECT_TRUE(std::equal(named.rgb.begin(), title, plain.rgb.begin()));
  EXPECT_NE(named.rgb, plain.rgb) << "the names are gone";
}

TEST(ChartPicture, OfNothingIsOnlyAxes) {
  const Picture picture = chartPicture({"Nothing", "x", "y", {}}, 300, 200);
  EXPECT_EQ(count(picture, 0, 300, 200), 0);
  EXPECT_EQ(chartRow({{}, {}, {}}, 100, 80).width, 300);
}

}  // namespace
}  // namespace pneuma
