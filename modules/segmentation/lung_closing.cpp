#include "segmentation/lung_closing.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/units.h"
#include "segmentation/closing.h"
#include "segmentation/inner_air.h"
#include "segmentation/lung_labels.h"

namespace pneuma {
namespace {

// Balls of the repair of dense parts; the larger one tells whether it matters.
constexpr double SoftRepairMm = 20.0;
constexpr double StrongRepairMm = 30.0;
constexpr double CoarseMm = 2.5;  ///< voxels in plane, where only a share is asked for

double ballMm(const LungOptions& options) {
  switch (options.repair) {
    case DenseRepair::Soft:
      return std::max(SoftRepairMm, options.closingMm);
    case DenseRepair::Strong:
      return std::max(StrongRepairMm, options.closingMm);
    default:
      return options.closingMm;
  }
}

/// What closing by the ball of the strong repair would add to a lung, as a share of it.
double denseShare(const LabelImage& labels, std::uint8_t label, const Progress& progress) {
  const VoxelBox box = boxOf(labels, label, StrongRepairMm);
  if (box.voxelCount() == 0) return 0.0;
  const Vec3& spacing = labels.geometry.spacing;
  const int step = std::max(1, static_cast<int>(std::lround(CoarseMm / spacing.x())));
  const std::array<int, 3> size = {(box.size[0] + step - 1) / step, (box.size[1] + step - 1) / step,
                                   box.size[2]};
  const auto& [width, height, depth] = labels.geometry.size;

  enum : std::uint8_t { Elsewhere, Lung, Other };

  std::vector<std::uint8_t> there;
  there.reserve(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                static_cast<std::size_t>(size[2]));
  for (int k = 0; k < size[2]; ++k) {
    progress.throwIfStopped();
    for (int j = box.low.y(); j < box.low.y() + box.size[1]; j += step) {
      for (int i = box.low.x(); i < box.low.x() + box.size[0]; i += step) {
        const bool inside = i >= 0 && j >= 0 && i < width && j < height;
        const int value = inside ? labels.at(i, j, box.low.z() + k) : 0;
        there.push_back(value == label ? Lung : inside && value == 0 ? Elsewhere : Other);
      }
    }
  }
  std::vector<std::uint8_t> closed(there.size());
  std::transform(there.begin(), there.end(), closed.begin(),
                 [](std::uint8_t v) { return v == Lung ? std::uint8_t{1} : std::uint8_t{0}; });
  closeByBall(closed, size, spacing.cwiseProduct(Vec3(step, step, 1.0)), StrongRepairMm, progress);
  double before = 0.0;
  double added = 0.0;
  for (std::size_t v = 0; v < there.size(); ++v) {
    if (there[v] == Lung) before += 1.0;
    if (there[v] == Elsewhere && closed[v] != 0) added += 1.0;
  }
  return before > 0.0 ? added / before : 0.0;
}

/// The lung's surface that lies at the border of the slices or of what the scanner saw, mm^2.
double borderMm2(const CtImage& ct, const LabelImage& labels, std::uint8_t label,
                 const VoxelBox& box) {
  const auto& [width, height, depth] = labels.geometry.size;
  const Vec3& spacing = labels.geometry.spacing;
  const double sideMm2 = spacing.y() * spacing.z();
  const double backMm2 = spacing.x() * spacing.z();
  const auto beyond = [&](int i, int j, int k) {
    return i < 0 || j < 0 || i >= width || j >= height || ct.at(i, j, k) < PaddingBelowHu;
  };
  std::vector<double> ofSlice(static_cast<std::size_t>(box.size[2]), 0.0);
  parallelFor(ofSlice.size(), [&](std::size_t n) {
    const int k = box.low.z() + static_cast<int>(n);
    for (int j = std::max(box.low.y(), 0); j < std::min(height, box.low.y() + box.size[1]); ++j) {
      for (int i = std::max(box.low.x(), 0); i < std::min(width, box.low.x() + box.size[0]); ++i) {
        if (labels.at(i, j, k) != label) continue;
        ofSlice[n] += (beyond(i - 1, j, k) ? sideMm2 : 0.0) +
                      (beyond(i + 1, j, k) ? sideMm2 : 0.0) +
                      (beyond(i, j - 1, k) ? backMm2 : 0.0) + (beyond(i, j + 1, k) ? backMm2 : 0.0);
      }
    }
  });
  double sum = 0.0;
  for (const double area : ofSlice) sum += area;
  return sum;
}

/// The lung's section in the first or last slice, mm^2.
double sectionMm2(const LabelImage& labels, std::uint8_t label, int slice) {
  const std::size_t count = labels.geometry.sliceCount();
  const auto first =
      labels.voxels.begin() + static_cast<std::ptrdiff_t>(count * static_cast<std::size_t>(slice));
  return static_cast<double>(std::count(first, first + static_cast<std::ptrdiff_t>(count), label)) *
         labels.geometry.spacing.x() * labels.geometry.spacing.y();
}

}  // namespace

LungFinding closeLung(const CtImage& ct, std::uint8_t label, const LungOptions& options,
                      LabelImage& labels, const Progress& progress) {
  LungFinding finding;
  const ImageGeometry& geometry = labels.geometry;
  const double radius = ballMm(options);
  const VoxelBox box = boxOf(labels, label, radius);
  if (box.voxelCount() == 0) return finding;
  const double voxelMl = millilitres(geometry.voxelMm3());
  std::vector<std::uint8_t> mask = maskOf(labels, label, box);
  finding.airMl =
      static_cast<double>(std::count(mask.begin(), mask.end(), std::uint8_t{1})) * voxelMl;
  closeByBall(mask, box.size, geometry.spacing, radius, progress);
  progress.report(0.6);
  fillHoles(mask, box.size, progress);

  // What is another's stays so; then what no longer hangs together goes.
  std::size_t airways = 0;
  forEachRow(box, geometry, [&](std::size_t at, std::size_t v, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint8_t there = labels.voxels[v + i];
      if (there == 0 || there == label) continue;
      if (there == AirwayLabel && mask[at + i] != 0) ++airways;
      mask[at + i] = 0;
    }
  });
  const auto all = static_cast<std::size_t>(std::count(mask.begin(), mask.end(), std::uint8_t{1}));
  const std::size_t voxels = keepLargest(mask, box.size, progress);
  finding.droppedMl = static_cast<double>(all - voxels) * voxelMl;
  progress.report(0.8);
  double sum = 0.0;
  forEachRow(box, geometry, [&](std::size_t at, std::size_t v, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (mask[at + i] != 0) {
        labels.voxels[v + i] = label;
        sum += ct.voxels[v + i];
      } else if (labels.voxels[v + i] == label) {
        labels.voxels[v + i] = 0;
      }
    }
  });
  mask = {};
  finding.volumeMl = static_cast<double>(voxels) * voxelMl;
  finding.volumeWithAirwaysMl = finding.volumeMl + static_cast<double>(airways) * voxelMl;
  finding.meanHu = voxels > 0 ? sum / static_cast<double>(voxels) : 0.0;
  finding.borderMm2 = borderMm2(ct, labels, label, box);
  finding.lowestSliceMm2 = sectionMm2(labels, label, 0);
  finding.highestSliceMm2 = sectionMm2(labels, label, geometry.size[2] - 1);
  progress.report(0.9);
  finding.denseShare = denseShare(labels, label, progress);
  progress.report(1.0);
  return finding;
}

void measureLung(const CtImage& ct, std::uint8_t label, double thresholdHu,
                 const LabelImage& labels, LungFinding& finding, const Progress& progress) {
  const ImageGeometry& geometry = labels.geometry;
  const double airwaysMl = finding.volumeWithAirwaysMl - finding.volumeMl;
  const double droppedMl = finding.droppedMl;
  finding = {};
  finding.droppedMl = droppedMl;

  struct Sums {
    std::int64_t hu = 0;
    std::size_t voxels = 0;
    std::size_t air = 0;
  };

  const std::size_t inSlice = geometry.sliceCount();
  std::vector<Sums> ofSlice(static_cast<std::size_t>(geometry.size[2]));
  parallelFor(ofSlice.size(), [&](std::size_t k) {
    for (std::size_t v = k * inSlice; v < (k + 1) * inSlice; ++v) {
      if (labels.voxels[v] != label) continue;
      ofSlice[k].hu += ct.voxels[v];
      ++ofSlice[k].voxels;
      if (ct.voxels[v] < thresholdHu) ++ofSlice[k].air;
    }
  });
  Sums sum;
  for (const Sums& slice : ofSlice) {
    sum.hu += slice.hu;
    sum.voxels += slice.voxels;
    sum.air += slice.air;
  }
  if (sum.voxels == 0) return;
  const double voxelMl = millilitres(geometry.voxelMm3());
  finding.volumeMl = static_cast<double>(sum.voxels) * voxelMl;
  finding.volumeWithAirwaysMl = finding.volumeMl + airwaysMl;
  finding.airMl = static_cast<double>(sum.air) * voxelMl;
  finding.meanHu = static_cast<double>(sum.hu) / static_cast<double>(sum.voxels);
  progress.report(0.2);
  finding.borderMm2 = borderMm2(ct, labels, label, boxOf(labels, label, 0.0));
  finding.lowestSliceMm2 = sectionMm2(labels, label, 0);
  finding.highestSliceMm2 = sectionMm2(labels, label, geometry.size[2] - 1);
  progress.report(0.4);
  finding.denseShare = denseShare(labels, label, progress);
  progress.report(1.0);
}

}  // namespace pneuma
