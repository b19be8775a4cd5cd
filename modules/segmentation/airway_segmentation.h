#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "segmentation/airway_finding.h"
#include "segmentation/airway_wavefront.h"

namespace pneuma {

/// The central airways of a CT and how they were found.
struct AirwayMask {
  std::vector<std::uint32_t> voxels;  ///< of the lumen, ascending; empty if no trachea was found
  std::uint32_t root = 0;             ///< at the top of the trachea
  Vec3 tracheaCentre = Vec3::Zero();  ///< of its lower half, voxels
  AirwayFinding finding;
};

/// Trachea and bronchi as far as their walls show: finds the trachea, floods the wide airways,
/// follows the others, and grows the result to the lumen's edge.
/// @param state a byte for every voxel, all 0; left with nonzero in the mask
AirwayMask segmentAirways(const CtImage& ct, const InnerAir& air, const WavefrontOptions& options,
                          std::vector<std::uint8_t>& state, const Progress& progress = {});

}  // namespace pneuma
