#pragma once

#include <cstddef>

namespace pneuma {

/// The airways as they were found.
struct AirwayFinding {
  bool found = false;
  double tracheaLengthMm = 0.0;
  double baseThresholdHu = 0.0;  ///< under which trachea and main bronchi flooded
  double baseMl = 0.0;           ///< what flooded
  double volumeMl = 0.0;
  std::size_t leaksUndone = 0;    ///< branches taken back because they grew too wide
  std::size_t wallsMissed = 0;    ///< branches taken back because they had no wall
  std::size_t stepsFollowed = 0;  ///< beyond what flooded
  double largestStepMl = 0.0;     ///< that was kept, of those beyond what flooded
};

}  // namespace pneuma
