#pragma once

#include <string>

#include "core/progress.h"
#include "core/triangle_mesh.h"
#include "lobes/region_splitting.h"

namespace pneuma {

/// A fissure as a surface that may fold, so that it is no height over a plane.
struct FissureSheet {
  TriangleMesh mesh;      ///< manifold, normals from below to above, without triangles that meet
  double extendMm = 0.0;  ///< how far its rim may end before the wall, above RimToleranceMm
};

/// A mesh as a fissure.
/// @param above where the side lies that its normals shall point to; without a length: as they do
/// @param what names the mesh in sentences ("surface of the left oblique fissure")
/// @throws InvalidInput if it is no oriented surface, meets itself, or stands so that neither side
/// is above
FissureSheet fissureSheet(TriangleMesh mesh, const Vec3& above, double extendMm,
                          const std::string& what);

/// Splits a region along a sheet: both surfaces are divided along the line in which they cut, and
/// what lies of the sheet inside the region becomes the contact of both parts. The same promises
/// as for a height surface (region_splitting.h); pieces on the wrong side go to the part around
/// them, so that what had cut them off vanishes.
/// @param settings the cap has the sheet's own triangles: the spacing does not matter
/// @throws InvalidInput if the sheet does not cross the region, ends inside it, does not part it,
/// or no cut without intersections was found; Cancelled
SplitReport splitRegion(RegionComplex& complex, const FissureSheet& sheet,
                        const SplitRegion& settings, const std::string& what,
                        const Progress& progress = {});

}  // namespace pneuma
