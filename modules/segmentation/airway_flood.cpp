#include "segmentation/airway_flood.h"

#include <algorithm>
#include <array>

#include "core/units.h"

namespace pneuma {
namespace {

constexpr int LowestHu = -1100;  ///< whatever is less dense counts as this
constexpr int HighestHu = -700;  ///< no airway's air is denser
constexpr int BucketHu = 4;
constexpr int BucketCount = (HighestHu - LowestHu) / BucketHu + 1;
constexpr int SeedBelowHu = -850;
constexpr double LeakMl = 40.0;
constexpr double MostMl = 150.0;  ///< no trachea and bronchi hold more
constexpr int LeakBuckets = 12 / BucketHu;
constexpr int SafetyBuckets = 8 / BucketHu;
constexpr std::size_t VoxelsBetweenStops = std::size_t{1} << 18U;

int bucketOf(int hu) { return std::max(hu - LowestHu, 0) / BucketHu; }

}  // namespace

AirwayBase floodTrachea(const CtImage& ct, const InnerAir& air, const Trachea& trachea,
                        std::vector<std::uint8_t>& state, const Progress& progress) {
  const ImageGeometry& geometry = ct.geometry;
  const double voxelMl = millilitres(geometry.voxelMm3());
  std::array<std::vector<std::uint32_t>, BucketCount> waiting;
  AirwayBase base;
  std::vector<std::uint32_t>& filled = base.voxels;

  // The trachea itself is no leak, however many of its voxels fall into one bucket.
  for (std::size_t s = trachea.root; s < trachea.sections.size(); ++s) {
    const TracheaSection& section = trachea.sections[s];
    forEachRun(air.runs, section.slice, [&](std::size_t row, const VoxelRun& run, std::uint32_t r) {
      if (air.inSlices.ofRun[r] != section.part) return;
      for (int i = run.first; i < run.end; ++i) {
        const std::size_t v = air.runs.rowVoxel(row) + static_cast<std::size_t>(i);
        if (ct.voxels[v] >= SeedBelowHu) continue;
        state[v] = 1;
        filled.push_back(static_cast<std::uint32_t>(v));
      }
    });
  }
  const auto width = static_cast<std::size_t>(geometry.size[0]);
  const std::size_t slice = geometry.sliceCount();
  const int topSlice = trachea.sections[trachea.root].slice;
  int current = 0;
  const auto offer = [&](std::size_t v) {
    if (state[v] != 0) return;
    const int hu = ct.voxels[v];
    if (hu >= HighestHu || hu < PaddingBelowHu) return;
    state[v] = 1;
    waiting[static_cast<std::size_t>(std::max(bucketOf(hu), current))].push_back(
        static_cast<std::uint32_t>(v));
  };
  const auto offerNeighbours = [&](std::uint32_t v) {
    const auto k = static_cast<int>(v / slice);
    const std::size_t inSlice = v % slice;
    const std::size_t i = inSlice % width;
    const std::size_t j = inSlice / width;
    if (i > 0) offer(v - 1);
    if (i + 1 < width) offer(v + 1);
    if (j > 0) offer(v - width);
    if (j + 1 < static_cast<std::size_t>(geometry.size[1])) offer(v + width);
    if (k > 0) offer(v - slice);
    if (k < topSlice) offer(v + slice);  // nothing above the root: larynx and mouth
  };
  for (std::size_t n = 0; n < filled.size(); ++n) offerNeighbours(filled[n]);

  std::array<std::size_t, BucketCount> filledUpTo{};
  int last = BucketCount - 1;
  for (current = 0; current < BucketCount; ++current) {
    auto& bucket = waiting[static_cast<std::size_t>(current)];
    for (std::size_t n = 0; n < bucket.size(); ++n) {
      if (n % VoxelsBetweenStops == 0) progress.throwIfStopped();
      const std::uint32_t v = bucket[n];
      filled.push_back(v);
      offerNeighbours(v);
    }
    filledUpTo[static_cast<std::size_t>(current)] = filled.size();
    const std::size_t before =
        current < LeakBuckets ? 0 : filledUpTo[static_cast<std::size_t>(current - LeakBuckets)];
    const bool tooMuch = static_cast<double>(filled.size()) * voxelMl > MostMl;
    if (tooMuch || (before > 0 && static_cast<double>(filled.size() - before) * voxelMl > LeakMl)) {
      last = current - LeakBuckets - SafetyBuckets;
      break;
    }
  }
  last = std::max(last, 0);
  // Everything that was touched and is not kept is free again.
  for (const auto& bucket : waiting) {
    for (const std::uint32_t v : bucket) state[v] = 0;
  }
  filled.resize(filledUpTo[static_cast<std::size_t>(last)]);
  for (const std::uint32_t v : filled) state[v] = 1;
  base.thresholdHu = LowestHu + (last + 1) * BucketHu;
  base.volumeMl = static_cast<double>(filled.size()) * voxelMl;
  return base;
}

}  // namespace pneuma
