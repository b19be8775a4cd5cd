#include "segmentation/lung_separation.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

constexpr int Width = 61;
constexpr int Height = 31;
constexpr int Depth = 31;
const VoxelBox Box{{100, 0, 0}, {Width, Height, Depth}};

/// Two balls of 12 voxels, centres at i = 15 and 45, and a tube between them.
std::vector<std::uint8_t> dumbbell(double tubeRadius) {
  std::vector<std::uint8_t> set(Box.voxelCount(), 0);
  for (int k = 0; k < Depth; ++k) {
    for (int j = 0; j < Height; ++j) {
      for (int i = 0; i < Width; ++i) {
        const Vec3 p(i, j, k);
        const bool ball =
            (p - Vec3(15, 15, 15)).norm() < 12.0 || (p - Vec3(45, 15, 15)).norm() < 12.0;
        const bool tube = i > 15 && i < 45 && std::hypot(j - 15, k - 15) < tubeRadius;
        set[Box.index(i, j, k)] = ball || tube ? 1 : 0;
      }
    }
  }
  return set;
}

TEST(SeparateLungs, CutsTheBridgeAtItsMiddle) {
  std::vector<std::uint8_t> set = dumbbell(4.0);
  const std::vector<std::uint8_t> before = set;
  const Separation separation = separateLungs(Box, Vec3::Ones(), 130.0, set);
  ASSERT_TRUE(separation.done);
  EXPECT_NEAR(separation.radiusMm, 4.0, 1.0);
  for (int k = 0; k < Depth; ++k) {
    for (int j = 0; j < Height; ++j) {
      for (int i = 0; i < Width; ++i) {
        const std::size_t v = Box.index(i, j, k);
        ASSERT_EQ(set[v] != 0, before[v] != 0) << "no voxel is lost or won";
        if (set[v] == 0) continue;
        if (i < 27) {
          ASSERT_EQ(set[v], 1);
        }
        if (i > 33) {
          ASSERT_EQ(set[v], 2);
        }
      }
    }
  }
}

TEST(SeparateLungs, FailsOnOneBody) {
  std::vector<std::uint8_t> set = dumbbell(4.0);
  for (int k = 0; k < Depth; ++k) {
    for (int j = 0; j < Height; ++j) {
      for (int i = 30; i < Width; ++i) set[Box.index(i, j, k)] = 0;
    }
  }
  EXPECT_FALSE(separateLungs(Box, Vec3::Ones(), 130.0, set).done);
}

TEST(SeparateLungs, FailsWhereBothPartsLieOnOneSide) {
  std::vector<std::uint8_t> set = dumbbell(4.0);
  EXPECT_FALSE(separateLungs(Box, Vec3::Ones(), 170.0, set).done);
}

}  // namespace
}  // namespace pneuma
