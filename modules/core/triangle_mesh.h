#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// Points (LPS, mm) and triangles (three indices into points, counter-clockwise seen from outside),
/// nothing else; attributes travel beside it.
struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Box3 bounds(const TriangleMesh& mesh);

/// mm^2
double areaMm2(const TriangleMesh& mesh);

/// Signed volume by the divergence theorem: positive for a closed mesh oriented outwards, mm^3.
double signedVolumeMm3(const TriangleMesh& mesh);

}  // namespace pneuma
