#pragma once

#include <optional>
#include <string>

#include "core/triangle_mesh.h"
#include "lobes/height_surface.h"

namespace pneuma {

/// An open surface as a height over its best plane.
struct PatchFit {
  HeightSurface surface;
  std::size_t knots = 0;   ///< points that the spline goes through
  double meanMm = 0.0;     ///< of the patch's points and triangles' middles from it
  double largestMm = 0.0;  ///< 2 at most, but where it folds
  /// Where it folds over its best plane, so that no height follows it: the spline is a smooth one
  /// that passes through the middle, to look at.
  std::optional<Vec3> fold;
};

/// The thin-plate spline through as many points of a patch, spread over it, as bring all of them,
/// and the middles of its triangles, within 0.2 mm of it, 800 at most.
/// @param what names it in sentences ("surface of the left oblique fissure")
/// @throws InvalidInput if the patch is closed, or has points that lie more than 2 mm from the
/// spline and does not fold
PatchFit fitPatch(const TriangleMesh& patch, const std::string& what);

}  // namespace pneuma
