#pragma once

#include <optional>

#include "segmentation/fissure_sheetness.h"

namespace pneuma {

/// What counts as a piece of a fissure beside a place.
struct SheetSearch {
  double reachMm = 3.0;        ///< along the normal, both ways
  double angleDeg = 30.0;      ///< between the sheet's normal and the one given
  double coherenceMm = 2.0;    ///< how far the sheet may be off in the places around
  double leastStrength = 4.0;  ///< HU / mm^2, mean of a patch
};

/// How far along the normal the strongest coherent sheet lies, mm; none if there is none.
///
/// Strength is averaged over a patch of nine places 2.5 mm apart across the normal. The peak must
/// be a local maximum, as strong as wanted, and two thirds of the places need a maximum of their
/// own near it: a vessel's wall or noise is strong in one place and not in the next.
/// @param normal of length 1
std::optional<double> coherentSheet(const SheetSampler& sheets, const Vec3& p, const Vec3& normal,
                                    const SheetSearch& search);

}  // namespace pneuma
