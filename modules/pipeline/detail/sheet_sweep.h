#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/progress.h"
#include "lobes/height_surface.h"
#include "segmentation/sheet_peak.h"

namespace pneuma {

/// Whether a place may be upon a fissure.
using FissureRegion = std::function<bool(const Vec3&)>;

/// Places upon a surface on a square grid over its plane, `width` to a row.
struct SurfaceGrid {
  int width = 0;
  int height = 0;
  std::vector<Vec3> places;
  std::vector<Vec3> normals;         ///< of the surface, of length 1
  std::vector<std::uint8_t> inside;  ///< 1 where the place is in the region, or near it

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// Those over a box. @param reachMm how far along the normal the region may lie
SurfaceGrid gridUpon(const HeightSurface& surface, const Box3& box, double spacingMm,
                     double reachMm, const FissureRegion& region);

/// How far along its normal each place of a grid has to go to lie on one smooth sheet.
struct Sweep {
  std::vector<double> offsetMm;
  std::vector<std::uint8_t> onSheet;  ///< 1 where a coherent sheet is; elsewhere the offset is what
                                      ///< the places around have, drawn towards zero
};

/// The smooth sheet near a surface that has most strength under it: of all offsets within reach,
/// those whose strength and steps from place to place cost least, by semi-global matching
/// (Hirschmueller 2008); then coherentSheet() at each place. Places that hang together with
/// fewer than `leastTogether` others do not count.
/// @param progress for stopping alone
Sweep sweepForSheet(const SheetSampler& sheets, const SurfaceGrid& grid, const SheetSearch& search,
                    std::size_t leastTogether, const Progress& progress = {});

}  // namespace pneuma
