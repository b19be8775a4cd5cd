#pragma once

#include <cstdint>

#include "core/image.h"
#include "core/progress.h"
#include "pipeline/detail/ct_body.h"

namespace pneuma {

/// How the sample's scanner measures.
struct ScanSettings {
  double blurMm = 0.6;  ///< standard deviation of the point spread within a slice
  double noiseHu = 20.0;
  double circleMm = 1e9;  ///< what is farther from the slice's centre becomes PaddingHu
  std::uint64_t seed = 1;
};

struct ScannedBody {
  CtImage image;
  LabelImage labels;  ///< by the voxels' centres
};

/// The body as a scanner sees it: every voxel is the mean over its parallelepiped, blurred within
/// its slice, with noise as fine as the blur. The same for any number of threads.
ScannedBody scanned(const CtBody& body, const ImageGeometry& geometry, const ScanSettings& settings,
                    const Progress& progress = {});

}  // namespace pneuma
