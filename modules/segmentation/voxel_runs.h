#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math.h"
#include "core/parallel.h"

namespace pneuma {

/// Neighbouring voxels of one row (j, k) that belong to a set: i in [first, end).
struct VoxelRun {
  int first = 0;
  int end = 0;
};

/// A set of voxels, as its runs along i in the order of the rows. Much smaller than a mask.
struct VoxelRuns {
  std::array<int, 3> size{};
  std::vector<VoxelRun> runs;
  std::vector<std::uint32_t> rowStart;  ///< of row j + size[1] k, and one more: the number of runs

  std::size_t rowCount() const {
    return static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
  }

  /// Where the first voxel of a row stands in the image.
  std::size_t rowVoxel(std::size_t row) const { return row * static_cast<std::size_t>(size[0]); }
};

/// The voxels of an image of `size` at which `test(index)` holds. @pre fewer than 2^32 runs
template <class Test>
VoxelRuns runsWhere(const std::array<int, 3>& size, const Test& test) {
  VoxelRuns set{size, {}, {}};
  const auto rows = static_cast<std::size_t>(size[1]);
  const auto slices = static_cast<std::size_t>(size[2]);
  std::vector<std::vector<VoxelRun>> ofSlice(slices);
  set.rowStart.assign(rows * slices + 1, 0);
  parallelFor(slices, [&](std::size_t k) {
    std::vector<VoxelRun>& found = ofSlice[k];
    for (std::size_t j = 0; j < rows; ++j) {
      const std::size_t row = k * rows + j;
      const std::size_t first = set.rowVoxel(row);
      const std::size_t before = found.size();
      int i = 0;
      while (i < size[0]) {
        while (i < size[0] && !test(first + static_cast<std::size_t>(i))) ++i;
        if (i == size[0]) break;
        VoxelRun run{i, i};
        while (i < size[0] && test(first + static_cast<std::size_t>(i))) ++i;
        run.end = i;
        found.push_back(run);
      }
      set.rowStart[row + 1] = static_cast<std::uint32_t>(found.size() - before);
    }
  });
  for (std::size_t row = 0; row < rows * slices; ++row) set.rowStart[row + 1] += set.rowStart[row];
  set.runs.reserve(set.rowStart.back());
  for (const auto& found : ofSlice) set.runs.insert(set.runs.end(), found.begin(), found.end());
  return set;
}

/// Calls `f(row, run, indexOfRun)` for every run of slice k.
template <class F>
void forEachRun(const VoxelRuns& set, int k, F&& f) {
  const auto rows = static_cast<std::size_t>(set.size[1]);
  for (std::size_t row = rows * static_cast<std::size_t>(k);
       row < rows * static_cast<std::size_t>(k + 1); ++row) {
    for (std::uint32_t r = set.rowStart[row]; r < set.rowStart[row + 1]; ++r) {
      f(row, set.runs[r], r);
    }
  }
}

/// Writes `value` into the voxels of every run for which `chosen(indexOfRun)` holds.
template <class Chosen>
void fillRuns(const VoxelRuns& set, const Chosen& chosen, std::uint8_t value,
              std::vector<std::uint8_t>& voxels) {
  for (int k = 0; k < set.size[2]; ++k) {
    forEachRun(set, k, [&](std::size_t row, const VoxelRun& run, std::uint32_t r) {
      if (!chosen(r)) return;
      const auto first = voxels.begin() + static_cast<std::ptrdiff_t>(set.rowVoxel(row));
      std::fill(first + run.first, first + run.end, value);
    });
  }
}

/// What hangs together, and how much it is.
struct VoxelComponent {
  std::size_t voxels = 0;
  Eigen::Vector3i low = Eigen::Vector3i::Constant(1 << 30);  ///< first voxel of its box
  Eigen::Vector3i high = Eigen::Vector3i::Constant(-1);      ///< last voxel of its box
  Vec3 sum = Vec3::Zero();                                   ///< of the voxels' (i, j, k)

  Vec3 centre() const { return sum / static_cast<double>(voxels); }
};

struct VoxelComponents {
  std::vector<std::uint32_t> ofRun;  ///< index into `all`, for every run
  std::vector<VoxelComponent> all;   ///< in the order in which their first runs come

  /// Indices into `all`, the largest component first.
  std::vector<std::size_t> bySize() const;
};

/// Along which axes voxels hang together.
enum class Connection { InSlices, InVolume };

/// The parts of a set whose voxels share faces, by union-find over runs.
VoxelComponents components(const VoxelRuns& set, Connection connection);

}  // namespace pneuma
