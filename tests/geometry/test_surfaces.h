#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"

/// Surfaces to test with, oriented outwards, mm.
namespace pneuma::testing {

TriangleMesh sphere(double radiusMm, const Vec3& centre = Vec3::Zero(), int subdivisions = 3);

/// A cube in 12 triangles, its corner of least coordinates at `low`.
TriangleMesh cube(double sideMm, const Vec3& low = Vec3::Zero());

TriangleMesh torus(double radiusMm, double tubeMm);

/// A ball with deep dents.
TriangleMesh dentedBall(double radiusMm);

/// Every triangle cut into four.
TriangleMesh subdivided(const TriangleMesh& mesh);

TriangleMesh insideOut(TriangleMesh mesh);

/// Both in one mesh, as they lie.
TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b);

TriangleMesh scaled(TriangleMesh mesh, double factor);

struct NamedSurface {
  std::string name;
  TriangleMesh mesh;
};

/// Generated surfaces of all kinds, and five real lobes if PNEUMA_TEST_DATA is set.
std::vector<NamedSurface> manySurfaces();

}  // namespace pneuma::testing
