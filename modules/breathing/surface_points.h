#pragma once

#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// A third of the triangles' area around each point, mm^2.
std::vector<double> pointAreas(const TriangleMesh& surface);

/// The mean of the triangles' normals around each point by their areas, of length 1; nothing at
/// points without a triangle.
std::vector<Vec3> pointNormals(const TriangleMesh& surface);

}  // namespace pneuma
