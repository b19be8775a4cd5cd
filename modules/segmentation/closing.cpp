#include "segmentation/closing.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "segmentation/distance_map.h"
#include "segmentation/voxel_runs.h"

namespace pneuma {

void closeByBall(std::vector<std::uint8_t>& set, const std::array<int, 3>& size,
                 const Vec3& spacing, double radiusMm, const Progress& progress) {
  if (radiusMm <= 0.0) return;
  const auto replace = [&](const std::vector<float>& distance2) {
    parallelFor(static_cast<std::size_t>(size[2]), [&](std::size_t k) {
      const std::size_t slice = set.size() / static_cast<std::size_t>(size[2]);
      for (std::size_t v = k * slice; v < (k + 1) * slice; ++v) {
        set[v] = std::isinf(distance2[v]) ? std::uint8_t{1} : std::uint8_t{0};
      }
    });
  };
  replace(squaredDistances(set, size, spacing, radiusMm,
                           progress));  // set where the ball does not reach
  replace(squaredDistances(set, size, spacing, radiusMm, progress));  // and far from there
}

void fillHoles(std::vector<std::uint8_t>& set, const std::array<int, 3>& size,
               const Progress& progress) {
  const VoxelRuns empty = runsWhere(size, [&](std::size_t v) { return set[v] == 0; });
  progress.throwIfStopped();
  const VoxelComponents parts = components(empty, Connection::InVolume);
  progress.throwIfStopped();
  const auto isHole = [&](const VoxelComponent& part) {
    return part.low.minCoeff() > 0 && part.high.x() + 1 < size[0] && part.high.y() + 1 < size[1] &&
           part.high.z() + 1 < size[2];
  };
  fillRuns(
      empty, [&](std::uint32_t r) { return isHole(parts.all[parts.ofRun[r]]); }, 1, set);
}

std::size_t keepLargest(std::vector<std::uint8_t>& set, const std::array<int, 3>& size,
                        const Progress& progress) {
  const VoxelRuns runs = runsWhere(size, [&](std::size_t v) { return set[v] != 0; });
  progress.throwIfStopped();
  const VoxelComponents parts = components(runs, Connection::InVolume);
  const std::vector<std::size_t> order = parts.bySize();
  if (order.empty()) return 0;
  fillRuns(
      runs, [&](std::uint32_t r) { return parts.ofRun[r] != order[0]; }, 0, set);
  return parts.all[order[0]].voxels;
}

std::vector<std::uint8_t> maskOf(const LabelImage& labels, std::uint8_t label,
                                 const VoxelBox& box) {
  std::vector<std::uint8_t> mask(box.voxelCount(), 0);
  parallelFor(static_cast<std::size_t>(box.size[2]), [&](std::size_t k) {
    forEachRow(box, labels.geometry, static_cast<int>(k),
               [&](std::size_t at, std::size_t v, std::size_t count) {
                 for (std::size_t i = 0; i < count; ++i) {
                   mask[at + i] = labels.voxels[v + i] == label ? 1 : 0;
                 }
               });
  });
  return mask;
}

VoxelBox boxOf(const LabelImage& labels, std::uint8_t label, double marginMm) {
  const auto [width, height, depth] = labels.geometry.size;
  const auto slices = static_cast<std::size_t>(depth);
  std::vector<Eigen::Vector3i> low(slices, Eigen::Vector3i::Constant(1 << 30));
  std::vector<Eigen::Vector3i> high(slices, Eigen::Vector3i::Constant(-1));
  parallelFor(slices, [&](std::size_t k) {
    const std::uint8_t* slice = labels.voxels.data() + k * labels.geometry.sliceCount();
    for (int j = 0; j < height; ++j) {
      const std::uint8_t* row = slice + static_cast<std::ptrdiff_t>(j) * width;
      const std::uint8_t* found = std::find(row, row + width, label);
      if (found == row + width) continue;
      int last = width - 1;
      while (row[last] != label) --last;
      const auto first = static_cast<int>(found - row);
      low[k] = low[k].cwiseMin(Eigen::Vector3i(first, j, static_cast<int>(k)));
      high[k] = high[k].cwiseMax(Eigen::Vector3i(last, j, static_cast<int>(k)));
    }
  });
  Eigen::Vector3i first = Eigen::Vector3i::Constant(1 << 30);
  Eigen::Vector3i last = Eigen::Vector3i::Constant(-1);
  for (std::size_t k = 0; k < slices; ++k) {
    first = first.cwiseMin(low[k]);
    last = last.cwiseMax(high[k]);
  }
  if (last.x() < 0) return {};
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const int margin = static_cast<int>(std::ceil(marginMm / labels.geometry.spacing[axis])) + 1;
    const auto a = static_cast<std::size_t>(axis);
    int from = first[axis] - margin;
    int end = last[axis] + margin + 1;
    if (axis == 2) {
      from = std::max(from, 0);
      end = std::min(end, depth);
    }
    box.low[axis] = from;
    box.size[a] = end - from;
  }
  return box;
}

}  // namespace pneuma
