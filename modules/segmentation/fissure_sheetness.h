#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"
#include "core/progress.h"

namespace pneuma {

/// How much a voxel looks like a piece of a thin bright sheet, and how that sheet lies.
struct SheetVoxel {
  static constexpr std::uint8_t NotMeasured = 255;  ///< outside the lung, or near its surface
  static constexpr double Step = 0.5;               ///< HU / mm^2

  std::uint8_t strength = NotMeasured;     ///< in steps; what is stronger than 254 counts as 254
  std::array<std::int8_t, 3> normal = {};  ///< of the sheet, LPS, times 127; either way round

  bool operator==(const SheetVoxel&) const = default;
};

/// Over the box of one lung: four bytes a voxel.
using SheetnessImage = Image<SheetVoxel>;

/// Fissures, and everything like them, in one lung of a CT: |l3| (|l3| - |l2|) / (|l3| + |l2|) of
/// the eigenvalues of the second derivatives, |l1| <= |l2| <= |l3|, where l3 is negative. Gaussian
/// derivatives of 1 mm (half a voxel at least); inside the lung densities are limited to -1000 ..
/// -300 HU, outside they count as -850 (docs/algorithms/snapping.md).
///
/// What lies within 2 mm of the lung's outside is not measured: pleura and bronchial walls are
/// sheets too, and stronger ones. Slices are worked one by one, so that beside the result no more
/// than a few of them are in memory.
/// @param labels of the same geometry
/// @throws InvalidInput if no voxel has the label; Cancelled
SheetnessImage fissureSheetness(const CtImage& ct, const LabelImage& labels, std::uint8_t label,
                                const Progress& progress = {});

/// Sheetness at points.
class SheetSampler {
 public:
  /// @param sheets is not kept, and must outlive the sampler
  explicit SheetSampler(const SheetnessImage& sheets);

  /// Strength at a point, HU / mm^2, of sheets whose normal is no farther from `normal` than an
  /// angle; linear between voxels, 0 where nothing is measured.
  /// @param normal of length 1
  double strength(const Vec3& p, const Vec3& normal, double cosine) const;

  /// False outside the lung and near its surface.
  bool isMeasured(const Vec3& p) const;

 private:
  const SheetnessImage& sheets_;
  Mat3 voxelFromMm_;
};

}  // namespace pneuma
