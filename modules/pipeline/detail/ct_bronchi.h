#pragma once

#include <cstdint>

#include "pipeline/detail/ct_body.h"
#include "pipeline/sample_chest.h"

namespace pneuma {

/// Airways and blood vessels of the sample CT.
struct CtBronchi {
  AirwayTree airways;  ///< those drawn; the chest's central ones come first
  CtBody shapes;       ///< lumens, then walls, then vessels
};

/// Grows bronchi, arteries beside them and veins between them in the chest's lobes. The trachea is
/// drawn up to `topMm`. @throws Cancelled
CtBronchi bronchi(const SampleChest& chest, double topMm, std::uint64_t seed,
                  const Progress& progress = {});

}  // namespace pneuma
