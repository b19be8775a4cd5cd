#include "segmentation/airway_segmentation.h"

#include <algorithm>

#include "core/units.h"

namespace pneuma {
namespace {

constexpr int GrowSteps = 2;
constexpr int GrowBelowHu = -700;

/// The voxel of a section that is nearest to its centre.
std::uint32_t rootVoxel(const CtImage& ct, const InnerAir& air, const TracheaSection& section) {
  std::uint32_t best = 0;
  double nearest = 1e30;
  const auto rows = static_cast<std::size_t>(ct.geometry.size[1]);
  forEachRun(air.runs, section.slice, [&](std::size_t row, const VoxelRun& run, std::uint32_t r) {
    if (air.inSlices.ofRun[r] != section.part) return;
    const double dy = static_cast<double>(row % rows) - section.centre.y();
    for (int i = run.first; i < run.end; ++i) {
      const double dx = i - section.centre.x();
      if (dx * dx + dy * dy >= nearest) continue;
      nearest = dx * dx + dy * dy;
      best = static_cast<std::uint32_t>(air.runs.rowVoxel(row) + static_cast<std::size_t>(i));
    }
  });
  return best;
}

/// Grows the mask in its slices: into air where two neighbours belong to it, into anything where
/// three do. Closes holes of noise and reaches the lumen's edge.
void growInSlices(const CtImage& ct, std::vector<std::uint32_t>& mask,
                  std::vector<std::uint8_t>& state) {
  const auto width = static_cast<std::size_t>(ct.geometry.size[0]);
  const auto height = static_cast<std::size_t>(ct.geometry.size[1]);
  const std::size_t slice = ct.geometry.sliceCount();
  std::vector<std::uint32_t> edge = mask;
  for (int step = 0; step < GrowSteps; ++step) {
    std::vector<std::uint32_t> added;
    for (const std::uint32_t from : edge) {
      const std::size_t i = from % slice % width;
      const std::size_t j = from % slice / width;
      if (i < 1 || j < 1 || i + 2 > width || j + 2 > height) continue;
      for (const std::size_t v : {from - 1UL, from + 1UL, from - width, from + width}) {
        if (state[v] != 0) continue;
        const std::size_t x = v % slice % width;
        const std::size_t y = v % slice / width;
        if (x < 1 || y < 1 || x + 2 > width || y + 2 > height) continue;
        const int neighbours = (state[v - 1] != 0 ? 1 : 0) + (state[v + 1] != 0 ? 1 : 0) +
                               (state[v - width] != 0 ? 1 : 0) + (state[v + width] != 0 ? 1 : 0);
        if (neighbours >= 3 || (neighbours == 2 && ct.voxels[v] < GrowBelowHu)) {
          added.push_back(static_cast<std::uint32_t>(v));
        }
      }
    }
    std::sort(added.begin(), added.end());
    added.erase(std::unique(added.begin(), added.end()), added.end());
    for (const std::uint32_t v : added) state[v] = 1;
    mask.insert(mask.end(), added.begin(), added.end());
    edge = std::move(added);
  }
}

}  // namespace

AirwayMask segmentAirways(const CtImage& ct, const InnerAir& air, const WavefrontOptions& options,
                          std::vector<std::uint8_t>& state, const Progress& progress) {
  AirwayMask mask;
  const Trachea trachea = findTrachea(ct, air);
  if (!trachea.found()) return mask;
  progress.report(0.2);
  const AirwayBase base = floodTrachea(ct, air, trachea, state, progress);
  progress.report(0.6);
  mask.root = rootVoxel(ct, air, trachea.sections[trachea.root]);
  Wavefront front = followAirways(ct, base, mask.root, options, state, progress);
  mask.voxels = std::move(front.voxels);
  growInSlices(ct, mask.voxels, state);
  std::sort(mask.voxels.begin(), mask.voxels.end());

  const std::size_t half = (trachea.root + trachea.sections.size()) / 2;
  for (std::size_t s = half; s < trachea.sections.size(); ++s) {
    mask.tracheaCentre += trachea.sections[s].centre;
  }
  mask.tracheaCentre /= static_cast<double>(trachea.sections.size() - half);
  mask.finding = {
      .found = true,
      .tracheaLengthMm = trachea.lengthMm(ct.geometry),
      .baseThresholdHu = base.thresholdHu,
      .volumeMl = millilitres(static_cast<double>(mask.voxels.size()) * ct.geometry.voxelMm3()),
      .leaksUndone = front.leaksUndone,
      .wallsMissed = front.wallsMissed,
      .largestStepMl = front.largestStepMl};
  progress.report(1.0);
  return mask;
}

}  // namespace pneuma
