#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/airway_flood.h"

namespace pneuma {

/// How airways are followed beyond what floods.
struct WavefrontOptions {
  double thresholdHu = -850.0;    ///< air is less dense, where a branch begins
  double wallContrastHu = 160.0;  ///< least difference between the air and what is around it
};

/// What following the airways gave.
struct Wavefront {
  std::vector<std::uint32_t> voxels;  ///< of the airways, base and beyond
  std::size_t leaksUndone = 0;        ///< branches taken back because they grew too wide
  std::size_t wallsMissed = 0;        ///< branches taken back because they had no wall
  std::size_t stepsFollowed = 0;      ///< that were kept, of those beyond the base
  double largestStepMl = 0.0;         ///< largest step that was kept, of those beyond the base
};

/// Follows the airways from where they begin in steps of about a slice along geodesic distance,
/// nowhere above that: larynx and mouth lie there. What a step adds is a front; where it falls into
/// parts, branches begin. A branch whose front grows wider than 1.6 times its narrowest so far, or
/// has no wall around it, is taken back and followed again under a threshold lower by 25 HU; below
/// -950 HU it ends before that step.
/// @param top the base's voxels in its highest slice
/// @param state as floodTrachea left it: 1 in the base; 2 is added where airways were followed
/// @param progress for stopping alone
/// @throws Cancelled
Wavefront followAirways(const CtImage& ct, const AirwayBase& base,
                        const std::vector<std::uint32_t>& top, const WavefrontOptions& options,
                        std::vector<std::uint8_t>& state, const Progress& progress = {});

}  // namespace pneuma
