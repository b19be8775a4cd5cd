#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// How the triangles of a mesh hang together, by their indices alone. Triangles that name a point
/// twice take no part in it.
struct MeshTopology {
  std::size_t openEdges = 0;               ///< edges with one triangle
  std::size_t nonManifoldEdges = 0;        ///< edges with more than two triangles
  std::size_t oddEdges = 0;                ///< edges with an odd number of triangles, open ones too
  std::size_t misorientedEdges = 0;        ///< edges whose two triangles turn the same way
  std::size_t nonManifoldVertices = 0;     ///< points where several fans of triangles meet
  std::size_t duplicateTriangles = 0;      ///< the same three points again
  std::size_t components = 0;              ///< edge-connected pieces
  std::vector<std::uint32_t> componentOf;  ///< by triangle; `components` where it takes no part

  /// Edges and points at which it is no closed, oriented surface.
  std::size_t faults() const {
    return openEdges + nonManifoldEdges + misorientedEdges + nonManifoldVertices;
  }
};

/// @pre indices lie within the points. Linear in the number of triangles.
MeshTopology topology(const TriangleMesh& mesh);

/// @throws InvalidInput if a coordinate is no number, an index points nowhere, or there are more
/// than 10^9 triangles
void requireSound(const TriangleMesh& mesh);

}  // namespace pneuma
