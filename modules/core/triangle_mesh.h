#pragma once

#include <array>
#include <cstdint>
#include <span>
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

/// Some triangles of a mesh as a mesh of their own, with the points that they use, in the order in
/// which they use them.
/// @param triangles with indices into the mesh's points
/// @param taken if given, gets the index in the mesh of every point of the part
TriangleMesh partOf(const TriangleMesh& mesh,
                    std::span<const std::array<std::uint32_t, 3>> triangles,
                    std::vector<std::uint32_t>* taken = nullptr);

}  // namespace pneuma
