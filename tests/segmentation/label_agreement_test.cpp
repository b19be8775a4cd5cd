#include "segmentation/label_agreement.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

/// A block of 10 x 10 x 10 voxels of 1 x 1 x 2 mm that begins at i = `from`.
LabelImage block(int from, std::uint8_t label = 10) {
  LabelImage image;
  image.geometry.size = {30, 14, 14};
  image.geometry.spacing = {1.0, 1.0, 2.0};
  image.voxels.assign(image.geometry.voxelCount(), 0);
  for (int k = 2; k < 12; ++k) {
    for (int j = 2; j < 12; ++j) {
      for (int i = from; i < from + 10; ++i) image.at(i, j, k) = label;
    }
  }
  return image;
}

TEST(LabelAgreement, OfAnImageWithItselfIsWhole) {
  const LabelAgreement same = agreement(block(5), block(5), 10);
  EXPECT_EQ(same.dice, 1.0);
  EXPECT_EQ(same.meanMm, 0.0);
  EXPECT_EQ(same.hausdorff95Mm, 0.0);
  EXPECT_NEAR(same.firstMl, 2.0, 1e-12);
}

TEST(LabelAgreement, OfAShiftedBlockIsKnown) {
  const LabelAgreement shifted = agreement(block(5), block(8), 10);
  EXPECT_NEAR(shifted.dice, 0.7, 1e-12);
  // The front face lies 3 mm from the other's; sides that overlap lie on each other.
  EXPECT_NEAR(shifted.hausdorff95Mm, 3.0, 1e-6);
  EXPECT_GT(shifted.meanMm, 0.3);
  EXPECT_LT(shifted.meanMm, 3.0);
}

TEST(LabelAgreement, TakesSeveralLabelsAsOne) {
  LabelImage two = block(5);
  for (int k = 2; k < 7; ++k) {
    for (int j = 2; j < 12; ++j) {
      for (int i = 5; i < 15; ++i) two.at(i, j, k) = 20;
    }
  }
  EXPECT_NEAR(agreement(block(5), two, 10).dice, 2.0 / 3.0, 1e-12);
  EXPECT_EQ(agreement(block(5), two, std::vector<std::uint8_t>{10, 20}).dice, 1.0);
  EXPECT_EQ(labelsIn(two), (std::vector<std::uint8_t>{10, 20}));
}

TEST(LabelAgreement, IsInfinitelyFarWhereOneHasNone) {
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  for (const std::uint8_t label : {std::uint8_t{10}, std::uint8_t{20}}) {
    const LabelAgreement none = agreement(block(5), block(5, 20), label);
    EXPECT_EQ(none.dice, 0.0);
    EXPECT_NEAR(none.firstMl + none.secondMl, 2.0, 1e-12);
    EXPECT_EQ(none.meanMm, Infinity);
    EXPECT_EQ(none.hausdorff95Mm, Infinity);
    EXPECT_EQ(none.volumeDifference(), Infinity);
  }
  const LabelAgreement neither = agreement(block(5), block(5), 6);
  EXPECT_EQ(neither.hausdorff95Mm, 0.0);
  EXPECT_EQ(neither.volumeDifference(), 0.0);
}

TEST(LabelAgreement, NeedsTheSameVoxels) {
  LabelImage moved = block(5);
  moved.geometry.origin.x() = 0.5;
  EXPECT_THROW(agreement(block(5), moved, 10), InvalidInput);
}

}  // namespace
}  // namespace pneuma
