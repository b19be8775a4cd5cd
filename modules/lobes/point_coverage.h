#pragma once

#include <span>

#include "core/triangle_mesh.h"
#include "lobes/height_surface.h"

namespace pneuma {

/// The share of a contact that the points given for it enclose: that within their convex hull, seen
/// along the surface's normal, 0 to 1. What lies beyond is a guess.
/// @param contact triangles between the lobes, not empty
double pointCoverage(std::span<const Vec3> points, const HeightSurface& surface,
                     const TriangleMesh& contact);

}  // namespace pneuma
