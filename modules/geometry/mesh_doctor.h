#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// What a surface is worth. Counts of 0 and `closed`, `manifold`, `orientedOutwards` are health.
struct MeshReport {
  std::size_t points = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;           ///< edge-connected pieces
  std::size_t openEdges = 0;            ///< edges with one triangle
  std::size_t nonManifoldEdges = 0;     ///< edges with more than two triangles
  std::size_t nonManifoldVertices = 0;  ///< points where several fans of triangles meet
  std::size_t misorientedEdges = 0;     ///< edges whose two triangles turn the same way
  std::size_t degenerateTriangles = 0;  ///< no area, or a point twice
  std::size_t duplicateTriangles = 0;   ///< the same three points again
  std::size_t selfIntersections = 0;    ///< pairs of triangles that cut each other
  bool selfIntersectionsCounted =
      false;                      ///< false where the mesh is too broken to ask, or not asked
  bool closed = false;            ///< no open edge, none with an odd number of triangles
  bool manifold = false;          ///< no non-manifold edge or vertex
  bool orientedOutwards = false;  ///< closed, consistently oriented, every piece the right way out
  double volumeMl = 0.0;          ///< absolute; 0 unless closed
  double areaMm2 = 0.0;
  Box3 box;
  std::string unitsGuess;  ///< "mm", "cm", "m" or "unknown", from the size of a lung

  /// Fit to grow in: closed, manifold, oriented outwards, no self-intersection, a volume.
  bool healthy() const;

  /// Healthy but for a few self-intersections, fewer than one in 200 triangles, as surfaces made
  /// from CT have them: where they are, inside and outside are those of parity; elsewhere nothing
  /// changes.
  bool fitToGrow() const;
};

enum class SelfIntersections { Ask, Skip };

/// Examines a surface; never changes it. @throws InvalidInput for NaN points or bad indices;
/// Cancelled
MeshReport examine(const TriangleMesh& mesh, SelfIntersections ask = SelfIntersections::Ask,
                   const Progress& progress = {});

/// Whole sentences on what is wrong and what to do; empty if healthy and in millimetres.
std::vector<std::string> complaints(const MeshReport& report);

}  // namespace pneuma
