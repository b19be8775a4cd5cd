#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/image.h"
#include "core/options.h"
#include "core/progress.h"

namespace pneuma {

/// What is mended in a CT while it is read; nothing, unless somebody asks.
struct CtCorrections {
  bool fixTilt = false;     ///< slices of a tilted gantry are shifted back over each other
  bool fillGaps = false;    ///< missing slices are interpolated
  double resampleMm = 0.0;  ///< side of the cubic voxels wanted; 0: as the scanner made them

  static constexpr auto fields() {
    using C = CtCorrections;
    return std::tuple{
        Field{"fix-tilt", &C::fixTilt, "", Range{0, 1},
              "Shift the slices of a tilted gantry back over each other."},
        Field{"fill-gaps", &C::fillGaps, "", Range{0, 1},
              "Interpolate missing slices between their neighbours."},
        Field{"resample", &C::resampleMm, "mm", Range{0.0, 20.0},
              "Resample to cubic voxels of this side; 0: leave them as they are."},
    };
  }

  bool operator==(const CtCorrections&) const = default;
};

/// A gantry tilted by no more than this stands straight: headers are rounded.
inline constexpr double LeastTiltDeg = 0.1;

/// Angle between the axis along which slices are stacked and their normal, degrees.
double tiltDeg(const ImageGeometry& geometry);

/// The image with slices `missing` (indices along k, of slices that hold nothing yet) interpolated
/// linearly between the nearest others. Where one of the two is padding, the nearer one counts.
/// @throws InvalidInput if the first or the last slice is missing
CtImage withSlicesFilled(CtImage image, std::span<const std::size_t> missing);

/// The image with its slices shifted in their planes until they stand straight over each other. The
/// grid grows sideways so that nothing is lost; new corners are padding. Shifts are whole pixels
/// first, the rest is interpolated by a cubic (Keys 1981) limited to the values around it.
CtImage untilted(const CtImage& image, const Progress& progress = {});

/// The image on cubic voxels of side `sideMm` that fill the same box to the nearest whole voxel,
/// its centre kept. Along each axis: linear interpolation where the new voxels are smaller, mean
/// weighted by a tent where they are larger; no value leaves the range of its sources. Padding
/// stays padding where it has the larger weight, and never mixes with tissue.
/// @param slicePositionsMm where the slices stand along k if unevenly, ascending; else empty
/// @throws Error (OutOfMemory) if the result would not fit
CtImage resampled(const CtImage& image, double sideMm,
                  std::span<const double> slicePositionsMm = {}, const Progress& progress = {});

/// @throws Error (OutOfMemory) if `bytes` are not free; `what` starts the sentence
void requireMemory(std::uint64_t bytes, const std::string& what);

}  // namespace pneuma
