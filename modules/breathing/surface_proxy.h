#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "breathing/point_matrix.h"

namespace pneuma {

/// A coarse surface in place of a fine one, for what changes little from one of its points to the
/// next. Its points are some of the fine ones, as evenly spread as those allow; two are joined
/// where the parts of the fine surface that are nearest to them touch.
struct SurfaceProxy {
  TriangleMesh mesh;

  /// Where a fine point lies on the coarse surface.
  struct Place {
    std::array<std::uint32_t, 3> corner{};
    std::array<double, 3> share{};  ///< of each corner, at least 0; sum up to 1
  };

  std::vector<Place> places;  ///< of every fine point

  /// Values of the coarse points at the fine ones.
  std::vector<double> atFinePoints(const std::vector<double>& coarse) const;

  /// Amounts at the fine points handed to the corners they lie between; their sum stays.
  std::vector<double> gathered(const std::vector<double>& fine) const;

  /// The coarse points' equation of the fine points' one: solved for gathered() right sides it
  /// gives the solution nearest to the fine one, in energy, of all that the coarse points can tell.
  PointMatrix condensed(const PointMatrix& fine) const;
};

/// @param edges any matrix of the surface's edges
/// @param points about as many as wanted; at most 1.7 times as many come out
/// @pre the surface has a triangle of some area
SurfaceProxy surfaceProxy(const TriangleMesh& surface, const PointMatrix& edges,
                          std::size_t points);

}  // namespace pneuma
