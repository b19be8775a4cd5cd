#include "breathing/strain_assignment.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "breathing/strained_surfaces.h"
#include "core/error.h"
#include "geometry/test_surfaces.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;

TEST(StrainCurve, GoesThroughThePapersTable) {
  const StrainCurve curve = StrainCurve::published();
  EXPECT_NEAR(curve.at(0.0), 0.4, 1e-12);
  EXPECT_NEAR(curve.at(0.5), 0.2, 1e-12);
  EXPECT_NEAR(curve.at(1.0), 0.075, 1e-12);
  EXPECT_NEAR(curve.at(0.25), 0.4 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(curve.at(0.75), 0.156509, 1e-6);
  EXPECT_EQ(curve.at(1.5), curve.at(1.0));
}

TEST(StrainCurve, AsPublishedHasACornerInTheMiddle) {
  const StrainCurve curve = StrainCurve::published();
  EXPECT_NEAR(curve.slope(0.5 - 1e-9), -0.4 * std::log(2.0), 1e-6);
  EXPECT_NEAR(curve.slope(0.5), 0.0, 1e-12);
}

TEST(StrainCurve, SmoothHasNoCornerAndTheSamePoints) {
  const StrainCurve curve = strainCurve(StrainPreset::Smooth);
  for (const StrainPoint& point : PublishedStrain) {
    EXPECT_NEAR(curve.at(point.r), point.strain, 1e-12);
  }
  EXPECT_NEAR(curve.slope(0.5 - 1e-9), curve.slope(0.5 + 1e-9), 1e-6);
  for (double r = 0.01; r < 0.99; r += 0.01) {
    EXPECT_LT(curve.at(r + 0.01), curve.at(r)) << r;
    EXPECT_NEAR(curve.slope(r), (curve.at(r + 1e-6) - curve.at(r - 1e-6)) / 2e-6, 1e-5) << r;
  }
}

TEST(StrainCurve, NeverLeavesTheRangeOfItsPoints) {
  const std::array<StrainPoint, 5> points = {
      {{0.0, 0.1}, {0.1, 0.1}, {0.15, 0.5}, {0.9, 0.51}, {1.0, 0.05}}};
  const StrainCurve curve(points);
  for (double r = 0.0; r <= 1.0; r += 0.001) {
    const auto after = std::ranges::lower_bound(points, r, {}, &StrainPoint::r);
    const StrainPoint& right = *after;
    const StrainPoint& left = after == points.begin() ? right : *std::prev(after);
    EXPECT_GE(curve.at(r), std::min(left.strain, right.strain) - 1e-12) << r;
    EXPECT_LE(curve.at(r), std::max(left.strain, right.strain) + 1e-12) << r;
  }
}

TEST(StrainCurve, OfEveryPresetIsSound) {
  for (std::size_t n = 0; n < choices(StrainPreset{}).size(); ++n) {
    const auto preset = static_cast<StrainPreset>(n);
    const StrainCurve curve = strainCurve(preset);
    for (const StrainPoint& point : strainPoints(preset)) {
      EXPECT_NEAR(curve.at(point.r), point.strain, 1e-12) << choices(preset)[n];
    }
  }
}

std::string refusalOfPoints(const std::vector<StrainPoint>& points) {
  try {
    const StrainCurve curve(points);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(StrainCurve, RefusesPointsThatAreNoCurve) {
  EXPECT_THAT(refusalOfPoints({}), HasSubstr("0 points"));
  EXPECT_THAT(refusalOfPoints({{0.0, 0.4}}), HasSubstr("1 points"));
  EXPECT_THAT(refusalOfPoints({{0.1, 0.4}, {1.0, 0.2}}), HasSubstr("from r = 0.1"));
  EXPECT_THAT(refusalOfPoints({{0.0, 0.4}, {0.5, 0.3}, {0.5, 0.2}, {1.0, 0.1}}),
              HasSubstr("point 3"));
  EXPECT_THAT(refusalOfPoints({{0.0, 0.4}, {1.0, 0.0}}), HasSubstr("point 2"));
  EXPECT_THAT(refusalOfPoints({{0.0, std::nan("")}, {1.0, 0.1}}), HasSubstr("point 1"));
}

TEST(InitialStrain, IsLargestAtTheDiaphragmAndLeastFarthestFromIt) {
  const TriangleMesh lung = testing::regularLung();
  const std::vector<std::uint32_t> region = diaphragmaticSurface(lung);
  Vec3 centroid = Vec3::Zero();
  for (const std::uint32_t n : region) {
    EXPECT_LT(lung.points[n].z(), 10.0);
    centroid += lung.points[n] / static_cast<double>(region.size());
  }
  EXPECT_NEAR((centroid - Vec3(-70.0, 10.0, centroid.z())).norm(), 0.0, 1.0);
  const std::vector<double> strain = testing::publishedStrainOf(lung);
  EXPECT_NEAR(*std::ranges::min_element(strain), 0.075, 1e-12);
  const auto lowest =
      std::ranges::min_element(lung.points, {}, [](const Vec3& p) { return p.z(); });
  EXPECT_GT(strain[static_cast<std::size_t>(lowest - lung.points.begin())], 0.35);
}

TEST(InitialStrain, TakesAnyRegion) {
  const TriangleMesh lung = testing::regularLung();
  const std::array<std::uint32_t, 1> one = {5};
  EXPECT_NEAR(initialStrain(lung, one, StrainCurve::published())[5], 0.4, 1e-12);
  const std::array<std::uint32_t, 1> gone = {99999};
  EXPECT_THROW(initialStrain(lung, gone, StrainCurve::published()), InvalidInput);
  EXPECT_THROW(initialStrain(lung, {}, StrainCurve::published()), InvalidInput);
}

TEST(DiaphragmaticSurface, IsNotFoundInsideOut) {
  EXPECT_THROW(diaphragmaticSurface(testing::insideOut(testing::regularLung())), InvalidInput);
}

}  // namespace
}  // namespace pneuma
