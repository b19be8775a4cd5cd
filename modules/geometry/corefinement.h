#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// Two surfaces whose triangles are divided along the line in which they cut each other. They have
/// their points in common, so that the line is the same for both.
struct Corefinement {
  std::vector<Vec3> points;  ///< those of the first surface as they were, then others
  std::vector<std::array<std::uint32_t, 3>> first;
  std::vector<std::uint32_t> parentOf;  ///< of triangles of `first`: which one they were part of
  std::vector<std::array<std::uint32_t, 3>> second;
  std::vector<std::array<std::uint32_t, 2>> line;  ///< edges that both have, the lower number first
};

/// Exact but for the rounding of new points to numbers of 53 bits.
/// @param first closed or open, manifold, without triangles that meet
/// @param second likewise; points that no triangle names are left out
/// @return nothing if the surfaces are not so where they meet
/// @throws Cancelled
std::optional<Corefinement> corefined(const TriangleMesh& first, const TriangleMesh& second,
                                      const Progress& progress = {});

}  // namespace pneuma
