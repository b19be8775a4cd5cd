#pragma once

#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// So many places of a fissure are looked at before it counts as reviewed.
inline constexpr std::size_t StationsPerFissure = 12;

/// Places upon a fissure at which to look at it in sagittal slices, from the patient's right to
/// left: one in each of `count` bands that have the same share of its area, there as far as can be
/// from the points that were set and from the other stations. What nobody clicked is seen first.
/// @param patch the fissure inside its lung, LPS, mm; without triangles there are no stations
/// @param points that were set upon it
std::vector<Vec3> reviewStations(const TriangleMesh& patch, std::span<const Vec3> points,
                                 std::size_t count = StationsPerFissure);

}  // namespace pneuma
