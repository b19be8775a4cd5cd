#pragma once

#include <algorithm>
#include <memory>

#include "pipeline/detail/level_table.h"

namespace pneuma {

/// The large surfaces of the sample's thorax that many of its parts are told from, as levels:
/// positive inside, about the distance to the surface in mm.
struct ThoraxLevels {
  LevelTable cage;     ///< what both lungs lie in, with the organs below them; ribs run around it
  LevelTable heart;    ///< with its fat
  LevelTable abdomen;  ///< what lies below the diaphragm
  LevelTable body;     ///< with its skin
};

std::shared_ptr<const ThoraxLevels> thoraxLevels();

/// The level of what lies between two limits of one coordinate.
inline double slabLevel(double value, double low, double high) {
  return std::min(value - low, high - value);
}

}  // namespace pneuma
