#include "segmentation/closing.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

/// Two slabs that face each other across `gap` voxels along an axis; size 41 each way.
std::vector<std::uint8_t> slabs(int axis, int gap) {
  std::vector<std::uint8_t> mask(41 * 41 * 41, 0);
  for (int k = 0; k < 41; ++k) {
    for (int j = 0; j < 41; ++j) {
      for (int i = 0; i < 41; ++i) {
        const int at = std::array{i, j, k}[static_cast<std::size_t>(axis)];
        const int first = 20 - gap / 2;
        mask[static_cast<std::size_t>(i + 41 * (j + 41 * k))] =
            at < first || at >= first + gap ? 1 : 0;
      }
    }
  }
  return mask;
}

TEST(CloseByBall, ShutsGapsThinnerThanTheBallAndNoOthers) {
  const Vec3 spacing(0.7, 0.8, 2.5);
  constexpr double Radius = 3.0;
  for (int axis = 0; axis < 3; ++axis) {
    // Between the centres of the slabs' last voxels lie gap + 1 steps; a ball fits if each of its
    // points can be farther than the radius from both.
    for (int gap = 1; gap < 14; ++gap) {
      std::vector<std::uint8_t> mask = slabs(axis, gap);
      const auto before = std::count(mask.begin(), mask.end(), 1);
      closeByBall(mask, {41, 41, 41}, spacing, Radius);
      const int middle = (gap + 1) / 2;
      const bool fits = middle * spacing[axis] > Radius;
      const auto after = std::count(mask.begin(), mask.end(), 1);
      if (fits) {
        EXPECT_EQ(after, before) << "axis " << axis << " gap " << gap;
      } else {
        EXPECT_EQ(after, 41 * 41 * 41) << "axis " << axis << " gap " << gap;
      }
    }
  }
}

TEST(CloseByBall, LeavesAConvexBodyAlone) {
  std::vector<std::uint8_t> mask(41 * 41 * 41, 0);
  for (int k = 0; k < 41; ++k) {
    for (int j = 0; j < 41; ++j) {
      for (int i = 0; i < 41; ++i) {
        const Vec3 p = Vec3(i - 20, j - 20, k - 20).cwiseProduct(Vec3(0.7, 0.7, 1.0));
        if (p.norm() < 8.0) mask[static_cast<std::size_t>(i + 41 * (j + 41 * k))] = 1;
      }
    }
  }
  std::vector<std::uint8_t> closed = mask;
  closeByBall(closed, {41, 41, 41}, {0.7, 0.7, 1.0}, 4.0);
  long changed = 0;
  for (std::size_t v = 0; v < mask.size(); ++v) {
    EXPECT_GE(closed[v], mask[v]);
    changed += closed[v] != mask[v] ? 1 : 0;
  }
  EXPECT_LT(static_cast<double>(changed),
            0.01 * static_cast<double>(std::count(mask.begin(), mask.end(), 1)));
}

TEST(FillHoles, FillsWhatIsShutInAndNothingElse) {
  const std::array<int, 3> size = {7, 7, 7};
  std::vector<std::uint8_t> mask(343, 0);
  const auto at = [](int i, int j, int k) { return static_cast<std::size_t>(i + 7 * (j + 7 * k)); };
  for (int k = 1; k < 6; ++k) {
    for (int j = 1; j < 6; ++j) {
      for (int i = 1; i < 6; ++i) mask[at(i, j, k)] = 1;
    }
  }
  mask[at(3, 3, 3)] = 0;  // a hole
  mask[at(1, 1, 1)] = 0;  // a dent
  fillHoles(mask, size);
  EXPECT_EQ(mask[at(3, 3, 3)], 1);
  EXPECT_EQ(mask[at(1, 1, 1)], 0);
  EXPECT_EQ(mask[at(0, 0, 0)], 0);
}

TEST(KeepLargest, KeepsTheLargest) {
  const std::array<int, 3> size = {6, 1, 1};
  std::vector<std::uint8_t> mask = {1, 0, 1, 1, 0, 1};
  EXPECT_EQ(keepLargest(mask, size), 2U);
  EXPECT_EQ(mask, (std::vector<std::uint8_t>{0, 0, 1, 1, 0, 0}));
}

TEST(BoxOf, ReachesBeyondTheImageInPlaneOnly) {
  LabelImage labels;
  labels.geometry.size = {10, 10, 10};
  labels.voxels.assign(1000, 0);
  labels.at(0, 5, 9) = 20;
  const VoxelBox box = boxOf(labels, 20, 2.0);
  EXPECT_EQ(box.low, Eigen::Vector3i(-3, 2, 6));
  EXPECT_EQ(box.size, (std::array{7, 7, 4}));
  EXPECT_EQ(boxOf(labels, 10, 2.0).voxelCount(), 0U);
}

}  // namespace
}  // namespace pneuma
