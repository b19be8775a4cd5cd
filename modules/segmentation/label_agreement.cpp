#include "segmentation/label_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/units.h"
#include "segmentation/closing.h"
#include "segmentation/distance_map.h"
#include "segmentation/distance_summary.h"

namespace pneuma {
namespace {

constexpr double SamePlaceMm = 1e-3;

void requireSameVoxels(const ImageGeometry& a, const ImageGeometry& b) {
  const Vec3 last(a.size[0] - 1, a.size[1] - 1, a.size[2] - 1);
  const bool same =
      a.size == b.size &&
      (a.worldFromVoxel(Vec3::Zero()) - b.worldFromVoxel(Vec3::Zero())).norm() < SamePlaceMm &&
      (a.worldFromVoxel(last) - b.worldFromVoxel(last)).norm() < SamePlaceMm &&
      (a.steps() - b.steps()).norm() < SamePlaceMm;
  if (!same) {
    throw InvalidInput(
        "the two label images do not have the same voxels at the same places; resample one to the "
        "grid of the other first");
  }
}

using Chosen = std::array<bool, 256>;

/// The box of all chosen voxels of both images with one voxel around it, and one byte each.
struct Pair {
  VoxelBox box;
  std::vector<std::uint8_t> first;
  std::vector<std::uint8_t> second;
};

Pair pairOf(const LabelImage& first, const LabelImage& second, const Chosen& chosen) {
  Pair pair;
  Eigen::Vector3i low = Eigen::Vector3i::Constant(1 << 30);
  Eigen::Vector3i high = Eigen::Vector3i::Constant(-1);
  const auto [width, height, depth] = first.geometry.size;
  for (int k = 0; k < depth; ++k) {
    for (int j = 0; j < height; ++j) {
      for (int i = 0; i < width; ++i) {
        const std::size_t v = first.geometry.index(i, j, k);
        if (!chosen[first.voxels[v]] && !chosen[second.voxels[v]]) continue;
        low = low.cwiseMin(Eigen::Vector3i(i, j, k));
        high = high.cwiseMax(Eigen::Vector3i(i, j, k));
      }
    }
  }
  if (high.x() < 0) return pair;
  pair.box = boxAround(low, high);
  pair.first.assign(pair.box.voxelCount(), 0);
  pair.second.assign(pair.box.voxelCount(), 0);
  forEachRow(pair.box, first.geometry, [&](std::size_t at, std::size_t v, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      pair.first[at + i] = chosen[first.voxels[v + i]] ? 1 : 0;
      pair.second[at + i] = chosen[second.voxels[v + i]] ? 1 : 0;
    }
  });
  return pair;
}

/// Voxels of a mask with a neighbour outside it. The mask has an empty voxel all around.
std::vector<std::uint8_t> boundaryOf(const std::vector<std::uint8_t>& mask, const VoxelBox& box) {
  const auto row = static_cast<std::ptrdiff_t>(box.size[0]);
  const std::array<std::ptrdiff_t, 3> steps = {1, row, row * box.size[1]};
  std::vector<std::uint8_t> boundary(mask.size(), 0);
  for (std::size_t v = 0; v < mask.size(); ++v) {
    if (mask[v] == 0) continue;
    for (const std::ptrdiff_t step : steps) {
      const auto at = static_cast<std::ptrdiff_t>(v);
      if (mask[static_cast<std::size_t>(at - step)] == 0 ||
          mask[static_cast<std::size_t>(at + step)] == 0) {
        boundary[v] = 1;
      }
    }
  }
  return boundary;
}

/// Distances from every voxel of one boundary to the other, mm.
std::vector<double> distancesTo(const std::vector<std::uint8_t>& from,
                                const std::vector<std::uint8_t>& to, const VoxelBox& box,
                                const Vec3& spacing) {
  const std::vector<float> map =
      squaredDistances(to, box.size, spacing, std::numeric_limits<float>::max());
  std::vector<double> distances;
  for (std::size_t v = 0; v < from.size(); ++v) {
    if (from[v] != 0) distances.push_back(std::sqrt(static_cast<double>(map[v])));
  }
  return distances;
}

LabelAgreement agreementOf(const LabelImage& first, const LabelImage& second,
                           const Chosen& chosen) {
  requireSameVoxels(first.geometry, second.geometry);
  const Pair pair = pairOf(first, second, chosen);
  const double voxelMl = millilitres(first.geometry.voxelMm3());
  double inFirst = 0.0;
  double inSecond = 0.0;
  double inBoth = 0.0;
  for (std::size_t v = 0; v < pair.first.size(); ++v) {
    inFirst += pair.first[v];
    inSecond += pair.second[v];
    inBoth += pair.first[v] & pair.second[v];
  }
  LabelAgreement result;
  result.firstMl = inFirst * voxelMl;
  result.secondMl = inSecond * voxelMl;
  if (inFirst + inSecond > 0.0) result.dice = 2.0 * inBoth / (inFirst + inSecond);
  if (result.inOneOnly()) {
    result.meanMm = result.hausdorff95Mm = std::numeric_limits<double>::infinity();
  }
  if (inFirst == 0.0 || inSecond == 0.0) return result;
  const Vec3& spacing = first.geometry.spacing;
  const auto a = boundaryOf(pair.first, pair.box);
  const auto b = boundaryOf(pair.second, pair.box);
  const DistanceSummary distances =
      summaryOf(distancesTo(a, b, pair.box, spacing), distancesTo(b, a, pair.box, spacing));
  result.meanMm = distances.meanMm;
  result.hausdorff95Mm = distances.hausdorff95Mm;
  return result;
}

}  // namespace

std::vector<std::uint8_t> labelsIn(const LabelImage& image) {
  Chosen there{};
  for (const std::uint8_t label : image.voxels) there[label] = true;
  std::vector<std::uint8_t> labels;
  for (std::size_t label = 1; label < there.size(); ++label) {
    if (there[label]) labels.push_back(static_cast<std::uint8_t>(label));
  }
  return labels;
}

LabelAgreement agreement(const LabelImage& first, const LabelImage& second, std::uint8_t label) {
  LabelAgreement result = agreement(first, second, std::vector{label});
  result.label = label;
  return result;
}

LabelAgreement agreement(const LabelImage& first, const LabelImage& second,
                         const std::vector<std::uint8_t>& labels) {
  Chosen chosen{};
  for (const std::uint8_t label : labels) chosen[label] = true;
  return agreementOf(first, second, chosen);
}

}  // namespace pneuma
