#pragma once

#include <string>

#include "core/progress.h"
#include "lobes/height_surface.h"
#include "lobes/region_complex.h"

namespace pneuma {

/// Which region is split, and what its parts are called.
struct SplitRegion {
  RegionId region = 1;
  RegionId below = 1;  ///< where the fissure's height is negative
  RegionId above = 2;
  double capSpacingMm = 2.5;
};

/// What it took to split a region.
struct SplitReport {
  int rounds = 1;                ///< tries until nothing intersected
  std::size_t piecesJoined = 0;  ///< pieces that the cut had left on the wrong side
  double joinedMm3 = 0.0;        ///< their volume
  double contactMm2 = 0.0;       ///< area of the new contact
  double lowestMm = 0.0;         ///< least height of the region over the fissure
  double highestMm = 0.0;
  double movedMm = 0.0;  ///< of the fissure along its normal, where it only touched the region
};

/// Splits a region along a fissure: both parts closed, manifold, each in one piece, sharing the
/// triangles of the fissure, and with the region's volume together. Pieces on the wrong side are
/// joined to the part around them; where the new triangles meet the region's own, the place is
/// divided finer and cut again, and if that does not help, the fissure is moved along its normal,
/// by up to 0.2 mm (docs/algorithms/lobes.md).
/// @param what names the fissure in sentences ("right oblique fissure")
/// @param complex is as it was if this throws
/// @throws InvalidInput if the fissure does not cross the region, folds, or no cut without
/// intersections was found; Cancelled
SplitReport splitRegion(RegionComplex& complex, const HeightSurface& fissure,
                        const SplitRegion& settings, const std::string& what,
                        const Progress& progress = {});

}  // namespace pneuma
