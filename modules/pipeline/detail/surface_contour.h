#pragma once

#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "lobes/height_surface.h"

namespace pneuma {

/// Where heights that points of a closed mesh have are zero, by marching triangles: closed lines.
/// @param heights of the mesh's points
std::vector<std::vector<Vec3>> zeroLines(const TriangleMesh& mesh, std::span<const float> heights);

/// What closed lines upon a surface enclose, as triangles of it with points this far apart. Empty
/// if the lines meet seen along the surface's normal.
TriangleMesh filled(const std::vector<std::vector<Vec3>>& lines, const HeightSurface& surface,
                    double spacingMm);

/// The parts of lines, and of a mesh, that lie above a surface.
std::vector<std::vector<Vec3>> above(const std::vector<std::vector<Vec3>>& lines,
                                     const HeightSurface& surface);
TriangleMesh above(const TriangleMesh& mesh, const HeightSurface& surface);

}  // namespace pneuma
