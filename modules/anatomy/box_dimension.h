#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// Slope of box counting between boxes of `boxMm` and of twice that:
/// log2(boxes of boxMm that centre lines pass through / the same for 2 boxMm).
struct BoxDimension {
  double boxMm = 0.0;
  double dimension = 0.0;
};

/// Box-counting dimension of the centre lines of `branches`, octave by octave: boxes of 2, 4, 8,
/// 16, 32 and 64 mm give five slopes. The boxes are nested and laid from the lowest corner of the
/// box around the branches; lines are followed exactly, not sampled. Empty for no branches.
/// @throws InvalidInput if the lines are too long for any lung (more than 20 km: wrong units)
std::vector<BoxDimension> boxDimensions(const AirwayTree& tree,
                                        std::span<const std::size_t> branches);

/// The same of points: boxes of `smallestBoxMm` and of `octaves` times twice that.
/// @throws InvalidInput if the points lie too far apart for boxes that small
std::vector<BoxDimension> boxDimensions(std::span<const Vec3> points, double smallestBoxMm,
                                        int octaves);

}  // namespace pneuma
