#include "pipeline/label_fit.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "anatomy/lobe.h"

namespace pneuma {
namespace {

constexpr std::int16_t LungHu = -850;
constexpr std::int16_t TissueHu = 40;

/// 30 x 30 x 30 voxels of 2 mm, of which those with i < 15 hold air.
CtImage halfOfAir() {
  CtImage ct;
  ct.geometry.size = {30, 30, 30};
  ct.geometry.spacing = Vec3(2.0, 2.0, 2.0);
  ct.voxels.assign(ct.geometry.voxelCount(), TissueHu);
  for (int k = 0; k < 30; ++k) {
    for (int j = 0; j < 30; ++j) {
      for (int i = 0; i < 15; ++i) ct.at(i, j, k) = LungHu;
    }
  }
  return ct;
}

/// Labels of the right lung where `from` <= i < `to`.
LabelImage slab(const ImageGeometry& geometry, int from, int to, Lobe lobe = Lobe::RightLung) {
  LabelImage labels;
  labels.geometry = geometry;
  labels.voxels.assign(geometry.voxelCount(), 0);
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = from; i < to; ++i) labels.at(i, j, k) = static_cast<std::uint8_t>(lobe);
    }
  }
  return labels;
}

TEST(LabelFit, CountsTheAirBelowLungsAndLobes) {
  const CtImage ct = halfOfAir();
  EXPECT_DOUBLE_EQ(*shareOfAir(ct, slab(ct.geometry, 0, 15)), 1.0);
  EXPECT_DOUBLE_EQ(*shareOfAir(ct, slab(ct.geometry, 15, 30, Lobe::LeftLower)), 0.0);
  // 9 columns in air, 12 in tissue.
  EXPECT_NEAR(*shareOfAir(ct, slab(ct.geometry, 6, 27, Lobe::RightMiddle)), 9.0 / 21.0, 1e-12);
}

TEST(LabelFit, GoesByPlacesNotByVoxels) {
  const CtImage ct = halfOfAir();
  ImageGeometry fine = ct.geometry;
  fine.size = {60, 30, 30};
  fine.spacing = Vec3(1.0, 2.0, 2.0);
  fine.origin = Vec3(-0.5, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(*shareOfAir(ct, slab(fine, 0, 30)), 1.0);
  // The same voxels elsewhere: 30 mm to the left, where no air is, and half of it outside.
  fine.origin = Vec3(29.5, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(*shareOfAir(ct, slab(fine, 0, 60)), 0.0);
}

TEST(LabelFit, SaysNothingWithoutLungs) {
  const CtImage ct = halfOfAir();
  EXPECT_FALSE(shareOfAir(ct, slab(ct.geometry, 0, 15, Lobe::Central)));
  EXPECT_FALSE(misfitOf(ct, slab(ct.geometry, 0, 0)));
}

TEST(LabelFit, WarnsBelowOneHalf) {
  const CtImage ct = halfOfAir();
  EXPECT_FALSE(misfitOf(ct, slab(ct.geometry, 3, 27)));  // 12 of 24
  const auto warning = misfitOf(ct, slab(ct.geometry, 6, 27));
  ASSERT_TRUE(warning);
  EXPECT_THAT(*warning, testing::HasSubstr("only 43 %"));
  EXPECT_THAT(*warning, testing::HasSubstr("another person"));
}

}  // namespace
}  // namespace pneuma
