#pragma once

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

}  // namespace pneuma
