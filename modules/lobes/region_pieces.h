#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lobes/region_complex.h"

namespace pneuma {

/// Pieces of a region that share no point.
std::size_t pieceCount(const RegionComplex& complex, RegionId region);

/// What a cut left on the wrong side.
struct StrayPieces {
  std::size_t count = 0;
  double volumeMm3 = 0.0;
  std::vector<std::uint32_t> facets;  ///< all of theirs
};

/// The pieces of one part of what was cut but for the largest of each body. A body is what hangs
/// together in both parts: a lung of two of them gives parts of two pieces each.
StrayPieces strayPieces(const RegionComplex& complex, RegionId part, RegionId other);

}  // namespace pneuma
