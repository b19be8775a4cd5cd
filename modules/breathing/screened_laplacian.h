#pragma once

#include <span>

#include "breathing/point_matrix.h"

namespace pneuma {

/// M E + l^2 L[E] of a surface: M the area of each point, E its stiffness, L the cotangent
/// Laplacian with each triangle's mean stiffness. Edges whose weight comes out below 0, which those
/// between obtuse triangles do, carry none: so no entry off the diagonal is above 0, and a right
/// side without a number below 0 has such a solution. What is solved with it is smooth over l,
/// whatever the size of the triangles.
/// @param areas of the surface's points
/// @param stiffness by point, above 0; empty: 1 everywhere
/// @param lengthMm l
PointMatrix screenedLaplacian(const TriangleMesh& surface, std::span<const double> areas,
                              std::span<const double> stiffness, double lengthMm);

}  // namespace pneuma
