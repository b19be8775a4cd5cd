#pragma once

#include <string>
#include <vector>

#include "core/progress.h"
#include "core/triangle_mesh.h"
#include "geometry/mesh_doctor.h"

namespace pneuma {

struct Repaired {
  TriangleMesh mesh;
  std::vector<std::string> changes;  ///< one sentence per kind of change, with its count
  MeshReport before;
  MeshReport after;
};

/// Mends what CGAL can mend: merges equal points, drops degenerate and duplicate triangles, closes
/// holes, turns the surface outwards, removes self-intersections. Everything done is listed.
/// @throws InvalidInput if nothing that encloses a volume is left; Cancelled
Repaired repaired(const TriangleMesh& mesh, const Progress& progress = {});

}  // namespace pneuma
