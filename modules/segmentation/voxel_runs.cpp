#include "segmentation/voxel_runs.h"

#include <algorithm>
#include <numeric>

#include "core/disjoint_sets.h"

namespace pneuma {
namespace {

/// Joins the runs of two rows that lie beside each other.
void joinRows(const VoxelRuns& set, std::size_t row, std::size_t other, DisjointSets& sets) {
  std::uint32_t a = set.rowStart[row];
  std::uint32_t b = set.rowStart[other];
  const std::uint32_t endA = set.rowStart[row + 1];
  const std::uint32_t endB = set.rowStart[other + 1];
  while (a < endA && b < endB) {
    const VoxelRun& runA = set.runs[a];
    const VoxelRun& runB = set.runs[b];
    if (runA.first < runB.end && runB.first < runA.end) sets.join(a, b);
    if (runA.end < runB.end) {
      ++a;
    } else {
      ++b;
    }
  }
}

}  // namespace

VoxelComponents components(const VoxelRuns& set, Connection connection) {
  DisjointSets sets(set.runs.size());
  const auto rows = static_cast<std::size_t>(set.size[1]);
  for (std::size_t row = 0; row < set.rowCount(); ++row) {
    if (row % rows != 0) joinRows(set, row, row - 1, sets);
    if (connection == Connection::InVolume && row >= rows) joinRows(set, row, row - rows, sets);
  }
  VoxelComponents result;
  result.ofRun.resize(set.runs.size());
  for (std::size_t row = 0; row < set.rowCount(); ++row) {
    const auto j = static_cast<int>(row % rows);
    const auto k = static_cast<int>(row / rows);
    for (std::uint32_t r = set.rowStart[row]; r < set.rowStart[row + 1]; ++r) {
      const std::uint32_t leader = sets.find(r);
      if (leader == r) {
        result.ofRun[r] = static_cast<std::uint32_t>(result.all.size());
        result.all.emplace_back();
      } else {
        result.ofRun[r] = result.ofRun[leader];
      }
      VoxelComponent& component = result.all[result.ofRun[r]];
      const VoxelRun& run = set.runs[r];
      const double length = run.end - run.first;
      component.voxels += static_cast<std::size_t>(run.end - run.first);
      component.low = component.low.cwiseMin(Eigen::Vector3i(run.first, j, k));
      component.high = component.high.cwiseMax(Eigen::Vector3i(run.end - 1, j, k));
      component.sum += length * Vec3(0.5 * (run.first + run.end - 1), j, k);
    }
  }
  return result;
}

std::vector<std::size_t> VoxelComponents::bySize() const {
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return all[a].voxels > all[b].voxels; });
  return order;
}

}  // namespace pneuma
