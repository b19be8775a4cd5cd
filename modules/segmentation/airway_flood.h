#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "segmentation/trachea.h"

namespace pneuma {

/// The wide airways: what fills from the trachea under a threshold of the CT's own.
struct AirwayBase {
  std::vector<std::uint32_t> voxels;
  double thresholdHu = 0.0;
  double volumeMl = 0.0;
};

/// Floods from the trachea in the order of rising density (a minimax path, so that one pass tells
/// the volume for every threshold) and takes what was filled well before the flood breaks into the
/// lungs: before it grows by more than 40 ml in 12 HU or beyond
/// 150 ml. No fixed threshold does: the same airways
/// leak at -900 HU in one CT and need -800 in another.
/// @param state a byte for every voxel, 0; those of the base are set to 1
/// @param progress for stopping alone
/// @throws Cancelled
AirwayBase floodTrachea(const CtImage& ct, const InnerAir& air, const Trachea& trachea,
                        std::vector<std::uint8_t>& state, const Progress& progress = {});

}  // namespace pneuma
