#include "anatomy/box_dimension.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/sample_trees.h"

namespace pneuma {
namespace {

using testing::addBranch;

std::vector<BoxDimension> dimensionsOf(const AirwayTree& tree) {
  std::vector<std::size_t> ids(tree.size());
  std::iota(ids.begin(), ids.end(), std::size_t{0});
  return boxDimensions(tree, ids);
}

/// Parallel lines of `lengthMm`, `rows` by `layers` of them 2 mm apart, each in boxes of its own.
AirwayTree lines(int rows, int layers, double lengthMm) {
  AirwayTree tree;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < rows; ++j) {
      Branch branch;
      branch.proximal = Vec3(0.0, 2.0 * j, 2.0 * k);
      branch.distal = branch.proximal + Vec3(lengthMm, 0.0, 0.0);
      tree.add(branch);
    }
  }
  return tree;
}

TEST(BoxDimension, IsListedPerOctave) {
  const std::vector<BoxDimension> dimensions = dimensionsOf(lines(1, 1, 100.0));
  ASSERT_EQ(dimensions.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(dimensions[k].boxMm, 2.0 * (1 << k));
}

TEST(BoxDimension, OfALineIsOne) {
  for (const BoxDimension& octave : dimensionsOf(lines(1, 1, 1279.0))) {
    EXPECT_NEAR(octave.dimension, 1.0, 1e-12) << octave.boxMm;
  }
}

TEST(BoxDimension, OfASlantedLineIsOne) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(900.0, -1100.0, 1300.0));
  for (const BoxDimension& octave : dimensionsOf(tree)) {
    EXPECT_NEAR(octave.dimension, 1.0, 0.05) << octave.boxMm;
  }
}

TEST(BoxDimension, OfAFilledPlaneIsTwoAndOfAFilledBlockThree) {
  for (const BoxDimension& octave : dimensionsOf(lines(320, 1, 639.0))) {
    EXPECT_NEAR(octave.dimension, 2.0, 1e-12) << octave.boxMm;
  }
  for (const BoxDimension& octave : dimensionsOf(lines(64, 64, 127.0))) {
    EXPECT_NEAR(octave.dimension, 3.0, 1e-12) << octave.boxMm;
  }
}

TEST(BoxDimension, FollowsLinesWithoutSkippingBoxes) {
  // From the middle of a box diagonally, a little off the corners: 3 boxes per diagonal step.
  AirwayTree tree;
  Branch branch;
  branch.proximal = Vec3(0.0, 0.0, 0.0);
  branch.distal = Vec3(128.0 - 0.1, 128.0 - 0.2, 128.0 - 0.3);
  tree.add(branch);
  // 64 boxes along each axis: 1 + 3 * 63 boxes of 2 mm, 1 + 3 * 31 of 4 mm.
  EXPECT_NEAR(dimensionsOf(tree)[0].dimension, std::log2(190.0 / 94.0), 1e-12);
}

TEST(BoxDimension, DoesNotDependOnHowALineIsCutOrWhichWayItRuns) {
  const Vec3 end(301.3, -97.7, 643.9);
  AirwayTree whole;
  addBranch(whole, -1, end);
  AirwayTree cut;
  for (int i = 0; i < 997; ++i) addBranch(cut, i - 1, end / 997.0);
  AirwayTree thereAndBack = whole;
  addBranch(thereAndBack, 0, -end);
  for (std::size_t octave = 0; octave < 5; ++octave) {
    const double expected = dimensionsOf(whole)[octave].dimension;
    EXPECT_NEAR(dimensionsOf(cut)[octave].dimension, expected, 1e-12);
    EXPECT_NEAR(dimensionsOf(thereAndBack)[octave].dimension, expected, 1e-12);
  }
}

TEST(BoxDimension, FollowsMeasuredCentrelines) {
  Branch detour;
  detour.proximal = Vec3::Zero();
  detour.distal = Vec3(1.0, 0.0, 0.0);
  detour.via = {{Vec3(0.0, 639.0, 0.0), 1.0}};
  AirwayTree tree;
  tree.add(detour);
  EXPECT_NEAR(dimensionsOf(tree)[4].dimension, 1.0, 1e-12);
}

TEST(BoxDimension, OfNothingIsEmpty) { EXPECT_TRUE(dimensionsOf({}).empty()); }

TEST(BoxDimension, RefusesLengthsThatNoLungHas) {
  AirwayTree tree;
  addBranch(tree, -1, Vec3(0.0, 0.0, 3e7));
  EXPECT_THROW(dimensionsOf(tree), InvalidInput);
}

}  // namespace
}  // namespace pneuma
