#pragma once

#include <random>

#include "core/triangle_mesh.h"

/// Surfaces to breathe with, mm.
namespace pneuma::testing {

/// A lung of 3 l that is narrow at its apex; triangles rise by the power of 4.
TriangleMesh lungShaped(int subdivisions);

/// The mesh with a point in the middle of every third triangle or so: points then have 3 to 12
/// edges.
TriangleMesh irregular(const TriangleMesh& mesh);

/// A square of `side` x `side` points, `stepMm` apart.
TriangleMesh sheet(int side, double stepMm);

/// Of length 1, any equally likely.
Vec3 anyDirection(std::mt19937& random);

}  // namespace pneuma::testing
