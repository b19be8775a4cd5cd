#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/progress.h"
#include "lobes/height_surface.h"
#include "lobes/region_complex.h"

namespace pneuma {

/// How a region is cut.
struct CutSettings {
  RegionId region = 1;  ///< that is cut
  RegionId below = 1;   ///< what it becomes where the height is negative
  RegionId above = 2;   ///< ... and where it is positive
  double snap = 0.1;    ///< the cut runs through a point this near, as a share of its edge
  double capSpacingMm = 2.5;
  std::vector<Vec2> capPoints;                            ///< that the cap has to have besides
  std::unordered_map<std::uint32_t, std::int8_t> sideOf;  ///< of points whose side is decided
  /// Heights of the complex's points over the surface, where they are known; empty: asked for.
  std::vector<double> heights = {};
};

enum class CutOutcome {
  Done,
  DoesNotCross,  ///< all of the region lies on one side
  Pinched,       ///< the cut meets itself in a point
  Folds,         ///< the cut's loops cross each other seen along the fissure's normal
};

/// What came of a cut.
struct Cut {
  CutOutcome outcome = CutOutcome::Done;
  double lowestMm = 0.0;                ///< least height of the region's points
  double highestMm = 0.0;               ///< largest
  std::size_t firstCapFacet = 0;        ///< the facets from here on are the cap
  std::vector<std::uint32_t> parentOf;  ///< of the facets before: which one they were part of
};

/// Cuts a region of a complex along a surface and closes both parts with the same triangles. The
/// region's surface is divided and not moved, and triangles of neighbours that share a divided edge
/// are divided with it, so that the parts' volumes sum up to the region's.
///
/// Signs of the height at the points; a new point where it is zero upon every edge that changes
/// sign; constrained Delaunay triangulation of the loops in the plane of the surface, with points
/// of a hexagonal grid lifted to it (docs/algorithms/lobes.md).
/// @param complex is changed; useless unless the outcome is Done
/// @throws Cancelled
Cut cutRegion(RegionComplex& complex, const HeightSurface& surface, const CutSettings& settings,
              const Progress& progress = {});

}  // namespace pneuma
