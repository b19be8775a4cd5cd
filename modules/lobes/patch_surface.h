#pragma once

#include <string>

#include "core/domain.h"
#include "core/triangle_mesh.h"
#include "lobes/height_surface.h"

namespace pneuma {

/// An open surface as a height over its best plane.
struct PatchFit {
  HeightSurface surface;
  std::size_t knots = 0;   ///< points that the spline goes through
  double meanMm = 0.0;     ///< of the patch's points and triangles' middles from it
  double largestMm = 0.0;  ///< 2 at most
};

/// The thin-plate spline through as many points of a patch, spread over it, as bring all of them,
/// and the middles of its triangles, within 0.2 mm of it, 800 at most.
/// @param what names it in sentences ("surface of the left oblique fissure")
/// @throws InvalidInput if the patch is closed, folds over its best plane, or else has points that
/// lie more than 2 mm from the spline
PatchFit fitPatch(const TriangleMesh& patch, const std::string& what);

/// The place of a patch's rim that lies deepest in a region.
struct RimPlace {
  Vec3 place = Vec3::Zero();
  double depthMm = 0.0;  ///< from the region's wall; 0 if the rim is outside
};

/// How far the patch is from reaching the wall of a region all around.
/// @param floor where the region ends below, besides; may be null
RimPlace deepestRim(const TriangleMesh& patch, const Domain& region, const HeightSurface* floor);

}  // namespace pneuma
