#include "anatomy/cluster_dimension.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "anatomy/box_dimension.h"
#include "core/error.h"
#include "core/random.h"

namespace pneuma {
namespace {

/// Points of a disc or ball of growing radius, nearer ones first: dimension `d` to the full.
std::vector<Vec3> filled(int d, std::size_t count) {
  Random random(1);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = std::pow(static_cast<double>(i + 1), 1.0 / d);
    const double z = d == 3 ? random.uniform(-1.0, 1.0) : 0.0;
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double across = std::sqrt(1.0 - z * z);
    points.push_back(radius * Vec3(across * std::cos(angle), across * std::sin(angle), z));
  }
  return points;
}

TEST(GyrationDimension, OfADiscIsTwoAndOfABallThree) {
  EXPECT_NEAR(gyrationDimension(filled(2, 20000)), 2.0, 0.01);
  EXPECT_NEAR(gyrationDimension(filled(3, 20000)), 3.0, 0.02);
}

TEST(CorrelationDimension, OfADiscIsTwoAndOfABallThree) {
  // Well inside: radii that are small beside the whole. Discs and balls of radius 141 and 27.
  EXPECT_NEAR(correlationDimension(filled(2, 20000), 3.0, 12.0, 1), 2.0, 0.08);
  EXPECT_NEAR(correlationDimension(filled(3, 20000), 2.0, 5.0, 1), 3.0, 0.2);
}

TEST(CorrelationDimension, OfALineIsOne) {
  std::vector<Vec3> line;
  for (int i = 0; i < 5000; ++i) line.emplace_back(0.1 * i, 0.0, 0.0);
  EXPECT_NEAR(correlationDimension(line, 2.0, 16.0, 1), 1.0, 0.02);
}

TEST(ClusterDimension, NeedsEnoughPoints) {
  const std::vector<Vec3> few(20, Vec3::Zero());
  EXPECT_THROW(gyrationDimension(few), InvalidInput);
  EXPECT_THROW(correlationDimension(few, 1.0, 2.0, 1), InvalidInput);
  EXPECT_THROW(correlationDimension(std::vector<Vec3>(200, Vec3::Zero()), 1.0, 2.0, 1),
               InvalidInput);
}

TEST(BoxDimensionOfPoints, OfALatticeIsItsDimensionInEveryOctave) {
  std::vector<Vec3> plane;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) plane.emplace_back(0.5 * i, 0.5 * j, 7.0);
  const auto slopes = boxDimensions(plane, 0.5, 5);
  ASSERT_EQ(slopes.size(), 5U);
  EXPECT_DOUBLE_EQ(slopes[0].boxMm, 0.5);
  EXPECT_DOUBLE_EQ(slopes[4].boxMm, 8.0);
  for (const BoxDimension& octave : slopes) EXPECT_DOUBLE_EQ(octave.dimension, 2.0);
}

}  // namespace
}  // namespace pneuma
