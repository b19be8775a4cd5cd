#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pneuma {

/// Triangles of a part of a plane.
struct PlanarTriangulation {
  std::vector<Eigen::Vector2d>
      points;  ///< those given, in their order, then the wanted ones that were taken
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
};

/// A point that is wanted inside, unless a point of a loop is nearer than `apart`.
struct WantedPoint {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double apart = 0.0;
};

/// A hexagonal grid of wanted points over a box, `step` from each to the next.
std::vector<WantedPoint> hexagonalGrid(const Eigen::AlignedBox2d& box, double step, double apart);

/// Constrained Delaunay triangulation of what closed loops enclose; a loop within a loop is a hole.
/// @param points of the loops
/// @param edges of the loops, from and to
/// @param wanted points inside; those outside are left out
/// @return nothing if edges cross, or two points are one
std::optional<PlanarTriangulation> triangulateInside(
    std::span<const Eigen::Vector2d> points, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const WantedPoint> wanted);

}  // namespace pneuma
