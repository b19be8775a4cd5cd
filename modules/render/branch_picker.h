#pragma once

#include <array>
#include <optional>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// How a camera maps space to a window.
struct Projection {
  std::array<double, 16> clipFromWorld{};  ///< row by row
  double width = 0.0;                      ///< pixels
  double height = 0.0;

  /// Pixel (origin at the lower left) and distance in front of the eye, mm; distance <= 0 behind
  /// it.
  Vec3 project(const Vec3& p) const;

  /// Pixels that 1 mm across the line of sight takes at this distance from the eye.
  double pixelsPerMm(double distance) const;
};

/// The visible branch under a pixel: of those whose tube covers it the one nearest to the viewer,
/// else the one whose tube passes within `tolerance` pixels, nearest on the screen.
std::optional<std::size_t> branchUnder(const AirwayTree& tree, const std::vector<bool>& visible,
                                       double radiusScale, const Projection& projection, double x,
                                       double y, double tolerance);

}  // namespace pneuma
