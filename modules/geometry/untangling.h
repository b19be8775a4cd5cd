#pragma once

#include <cstddef>

#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// What it took to part triangles that cut each other.
struct Untangled {
  std::size_t pairsBefore = 0;  ///< of triangles that cut each other
  std::size_t pairsAfter = 0;
  std::size_t movedPoints = 0;
  double farthestMm = 0.0;  ///< that a point was moved
};

/// Smooths a surface where triangles cut each other until none do: points of those triangles go to
/// the middle of their neighbours, round by round with more points around them. Triangles stay the
/// same. For the few folds that a surface drawn from voxels has; a mesh that is broken otherwise is
/// a matter for repaired(), and left as it was.
/// @throws Cancelled
Untangled untangle(TriangleMesh& mesh, const Progress& progress = {});

}  // namespace pneuma
