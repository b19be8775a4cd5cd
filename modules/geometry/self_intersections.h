#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// Triangles that meet elsewhere than in the points and edges they share.
struct SelfIntersecting {
  std::size_t pairs = 0;
  std::vector<std::uint32_t> triangles;  ///< those in any pair, ascending
};

/// Exact. Points at the same place count as shared. Triangles without area and copies of a triangle
/// are left out: they are faults of their own.
/// @throws Cancelled
SelfIntersecting selfIntersecting(const TriangleMesh& mesh, const Progress& progress = {});

}  // namespace pneuma
