#include "segmentation/lung_separation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "segmentation/distance_map.h"
#include "segmentation/voxel_runs.h"

namespace pneuma {
namespace {

constexpr std::array<double, 12> RadiiMm = {0.5, 1.0, 1.5, 2.0, 2.5,  3.0,
                                            4.0, 5.0, 6.0, 8.0, 10.0, 12.0};
constexpr double LeastShare = 0.2;  ///< of the smaller lung, to the larger

/// Distances fall into buckets this wide, mm.
constexpr double BucketMm = 0.1;

constexpr std::size_t VoxelsBetweenStops = std::size_t{1} << 20U;

/// The two largest parts if they lie on both sides of the middle and neither is a crumb.
bool areLungs(const VoxelComponents& parts, const std::vector<std::size_t>& order, double middle) {
  if (order.size() < 2) return false;
  const VoxelComponent& a = parts.all[order[0]];
  const VoxelComponent& b = parts.all[order[1]];
  return static_cast<double>(b.voxels) >= LeastShare * static_cast<double>(a.voxels) &&
         (a.centre().x() < middle) != (b.centre().x() < middle);
}

}  // namespace

void floodByDistance(const VoxelBox& box, const std::vector<float>& distance2,
                     std::vector<std::uint8_t>& marks, const Progress& progress) {
  const auto [width, height, depth] = box.size;
  const auto row = static_cast<std::size_t>(width);
  const std::size_t slice = row * static_cast<std::size_t>(height);
  std::vector<std::vector<std::uint32_t>> buckets;
  const auto bucketOf = [&](std::size_t v) {
    const double mm = std::min(std::sqrt(static_cast<double>(distance2[v])), 100.0);
    return static_cast<std::size_t>(mm / BucketMm);
  };
  buckets.resize(static_cast<std::size_t>(100.0 / BucketMm) + 1);
  std::size_t current = buckets.size() - 1;
  const auto offer = [&](std::size_t from, std::size_t v) {
    if (marks[v] != 0 || !(distance2[v] > 0.0F)) return;
    marks[v] = marks[from];
    buckets[std::min(bucketOf(v), current)].push_back(static_cast<std::uint32_t>(v));
  };
  // 32 bits: divisions are half of the time here.
  const auto row32 = static_cast<std::uint32_t>(row);
  const auto slice32 = static_cast<std::uint32_t>(slice);
  const auto offerNeighbours = [&](std::uint32_t v) {
    const std::uint32_t k = v / slice32;
    const std::uint32_t inSlice = v - k * slice32;
    const std::uint32_t j = inSlice / row32;
    const std::uint32_t i = inSlice - j * row32;
    if (i > 0) offer(v, v - 1);
    if (i + 1 < row32) offer(v, v + 1);
    if (j > 0) offer(v, v - row32);
    if (j + 1 < static_cast<std::uint32_t>(height)) offer(v, v + row32);
    if (k > 0) offer(v, v - slice32);
    if (k + 1 < static_cast<std::uint32_t>(depth)) offer(v, v + slice32);
  };
  const std::size_t count = box.voxelCount();
  std::vector<std::uint32_t> markers;
  for (std::size_t v = 0; v < count; ++v) {
    if (marks[v] != 0) markers.push_back(static_cast<std::uint32_t>(v));
  }
  for (std::size_t n = 0; n < markers.size(); ++n) {
    if (n % VoxelsBetweenStops == 0) progress.throwIfStopped();
    offerNeighbours(markers[n]);
  }
  while (true) {
    auto& bucket = buckets[current];
    for (std::size_t n = 0; n < bucket.size(); ++n) {
      if ((n + 1) % VoxelsBetweenStops == 0) progress.throwIfStopped();
      const std::uint32_t v = bucket[n];
      offerNeighbours(v);
    }
    bucket = {};
    progress.throwIfStopped();
    if (current == 0) break;
    --current;
  }
}

Separation separateLungs(const VoxelBox& box, const Vec3& spacing, double middle,
                         std::vector<std::uint8_t>& set, const Progress& progress) {
  std::vector<std::uint8_t> outside(set.size());
  std::transform(set.begin(), set.end(), outside.begin(),
                 [](std::uint8_t v) { return v == 0 ? std::uint8_t{1} : std::uint8_t{0}; });
  std::vector<float> distance2 = squaredDistances(outside, box.size, spacing, 30.0, progress);
  outside = {};
  progress.report(0.5);
  const double middleInBox = middle - box.low.x();
  for (const double radius : RadiiMm) {
    const auto least = static_cast<float>(radius * radius);
    const VoxelRuns wide = runsWhere(box.size, [&](std::size_t v) { return distance2[v] > least; });
    const VoxelComponents parts = components(wide, Connection::InVolume);
    const std::vector<std::size_t> order = parts.bySize();
    progress.throwIfStopped();
    if (!areLungs(parts, order, middleInBox)) continue;
    std::fill(set.begin(), set.end(), std::uint8_t{0});
    const bool firstIsRight = parts.all[order[0]].centre().x() < middleInBox;
    for (const std::size_t lung : {order[0], order[1]}) {
      const bool right = (lung == order[0]) == firstIsRight;
      fillRuns(
          wide, [&](std::uint32_t r) { return parts.ofRun[r] == lung; }, right ? 1 : 2, set);
    }
    floodByDistance(box, distance2, set, progress);
    progress.report(1.0);
    return {true, radius};
  }
  return {};
}

}  // namespace pneuma
