#include "segmentation/voxel_runs.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace pneuma {
namespace {

VoxelRuns runsOf(const std::array<int, 3>& size, const std::vector<std::uint8_t>& mask) {
  return runsWhere(size, [&](std::size_t v) { return mask[v] != 0; });
}

/// Components by flooding voxel for voxel over faces.
std::size_t countByFlooding(const std::array<int, 3>& size, std::vector<std::uint8_t> mask,
                            bool acrossSlices) {
  const auto index = [&](int i, int j, int k) {
    return static_cast<std::size_t>(i + size[0] * (j + size[1] * k));
  };
  std::size_t count = 0;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        if (mask[index(i, j, k)] == 0) continue;
        ++count;
        std::vector<std::array<int, 3>> stack = {{i, j, k}};
        mask[index(i, j, k)] = 0;
        while (!stack.empty()) {
          const auto [x, y, z] = stack.back();
          stack.pop_back();
          for (int axis = 0; axis < (acrossSlices ? 3 : 2); ++axis) {
            for (const int step : {-1, 1}) {
              std::array<int, 3> next = {x, y, z};
              next[static_cast<std::size_t>(axis)] += step;
              bool inside = true;
              for (std::size_t a = 0; a < 3; ++a) inside &= next[a] >= 0 && next[a] < size[a];
              if (!inside || mask[index(next[0], next[1], next[2])] == 0) continue;
              mask[index(next[0], next[1], next[2])] = 0;
              stack.push_back(next);
            }
          }
        }
      }
    }
  }
  return count;
}

TEST(VoxelRuns, HoldExactlyTheVoxelsThatPass) {
  const std::array<int, 3> size = {5, 2, 1};
  const std::vector<std::uint8_t> mask = {1, 1, 0, 1, 0, 0, 0, 0, 1, 1};
  const VoxelRuns set = runsOf(size, mask);
  ASSERT_EQ(set.runs.size(), 3U);
  EXPECT_EQ(set.rowStart, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(set.runs[0].first, 0);
  EXPECT_EQ(set.runs[0].end, 2);
  EXPECT_EQ(set.runs[2].first, 3);
  EXPECT_EQ(set.runs[2].end, 5);
}

TEST(VoxelComponents, EdgesAndCornersDoNotConnect) {
  const std::array<int, 3> size = {2, 2, 2};
  EXPECT_EQ(components(runsOf(size, {1, 0, 0, 1, 0, 0, 0, 0}), Connection::InVolume).all.size(),
            2U);
  EXPECT_EQ(components(runsOf(size, {1, 0, 0, 0, 0, 0, 0, 1}), Connection::InVolume).all.size(),
            2U);
  EXPECT_EQ(components(runsOf(size, {1, 1, 0, 0, 1, 0, 0, 0}), Connection::InVolume).all.size(),
            1U);
  EXPECT_EQ(components(runsOf(size, {1, 1, 0, 0, 1, 0, 0, 0}), Connection::InSlices).all.size(),
            2U);
}

TEST(VoxelComponents, AsManyAsFloodingFinds) {
  Random random(7);
  for (int round = 0; round < 20; ++round) {
    const std::array<int, 3> size = {1 + static_cast<int>(random.below(20)),
                                     1 + static_cast<int>(random.below(15)),
                                     1 + static_cast<int>(random.below(10))};
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(size[0] * size[1] * size[2]));
    for (auto& voxel : mask) voxel = random.uniform() < 0.4 ? 1 : 0;
    const VoxelRuns set = runsOf(size, mask);
    EXPECT_EQ(components(set, Connection::InVolume).all.size(), countByFlooding(size, mask, true));
    EXPECT_EQ(components(set, Connection::InSlices).all.size(), countByFlooding(size, mask, false));
  }
}

TEST(VoxelComponents, KnowTheirSizeBoxAndCentre) {
  const std::array<int, 3> size = {4, 3, 2};
  std::vector<std::uint8_t> mask(24, 0);
  for (const int i : {1, 2, 3}) mask[static_cast<std::size_t>(i + 4 * (1 + 3 * 1))] = 1;
  mask[0] = 1;
  const VoxelComponents parts = components(runsOf(size, mask), Connection::InVolume);
  const VoxelComponent& largest = parts.all[parts.bySize().front()];
  EXPECT_EQ(largest.voxels, 3U);
  EXPECT_EQ(largest.low, Eigen::Vector3i(1, 1, 1));
  EXPECT_EQ(largest.high, Eigen::Vector3i(3, 1, 1));
  EXPECT_EQ(largest.centre(), Vec3(2, 1, 1));
}

}  // namespace
}  // namespace pneuma
