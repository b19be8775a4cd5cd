#include "segmentation/airway_segmentation.h"

#include <algorithm>
#include <iterator>

#include "core/units.h"

namespace pneuma {
namespace {

constexpr int GrowSteps = 2;
constexpr int GrowBelowHu = -700;

/// The base's voxels in its highest slice: there the airways begin.
std::vector<std::uint32_t> topOf(const AirwayBase& base, const ImageGeometry& geometry) {
  const std::size_t slice = geometry.sliceCount();
  const std::uint32_t highest = *std::max_element(base.voxels.begin(), base.voxels.end());
  const std::size_t first = highest / slice * slice;
  std::vector<std::uint32_t> top;
  std::copy_if(base.voxels.begin(), base.voxels.end(), std::back_inserter(top),
               [&](std::uint32_t v) { return v >= first; });
  return top;
}

/// The one of some voxels of a slice that is nearest to their centre.
std::uint32_t middleOf(const std::vector<std::uint32_t>& voxels, const ImageGeometry& geometry) {
  const auto width = static_cast<std::size_t>(geometry.size[0]);
  const auto at = [&](std::uint32_t v) -> Vec3 {
    const std::size_t inSlice = v % geometry.sliceCount();
    return Vec3(static_cast<double>(inSlice % width), static_cast<double>(inSlice / width), 0.0)
        .cwiseProduct(geometry.spacing);
  };
  Vec3 centre = Vec3::Zero();
  for (const std::uint32_t v : voxels) centre += at(v) / static_cast<double>(voxels.size());
  return *std::min_element(voxels.begin(), voxels.end(), [&](std::uint32_t a, std::uint32_t b) {
    return (at(a) - centre).squaredNorm() < (at(b) - centre).squaredNorm();
  });
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
  if (base.voxels.empty()) return mask;
  const std::vector<std::uint32_t> top = topOf(base, ct.geometry);
  mask.root = middleOf(top, ct.geometry);
  Wavefront front = followAirways(ct, base, top, options, state, progress);
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
      .baseMl = base.volumeMl,
      .volumeMl = millilitres(static_cast<double>(mask.voxels.size()) * ct.geometry.voxelMm3()),
      .leaksUndone = front.leaksUndone,
      .wallsMissed = front.wallsMissed,
      .stepsFollowed = front.stepsFollowed,
      .largestStepMl = front.largestStepMl};
  progress.report(1.0);
  return mask;
}

}  // namespace pneuma
