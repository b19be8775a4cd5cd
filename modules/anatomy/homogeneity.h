#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/lobe.h"
#include "core/progress.h"

namespace pneuma {

/// Homogeneity: distance from random points of the region to the nearest terminal end, in units of
/// the spacing (volume / terminals)^(1/3). A cubic lattice of ends has mean 0.480 and max 0.866.
struct Gap {
  double mean = 0.0;
  double p95 = 0.0;
  double max = 0.0;  ///< over the random points
  double spacingMm = 0.0;
};

/// Points spread uniformly over regions, one list per region, in proportion to their volumes.
/// The same seed gives the same points whatever the number of threads.
/// @throws InvalidInput if a region has no volume or hardly fills its box (naming the lobe);
///         InvalidOption if `count` is 0 or more than 10 million; Cancelled
std::vector<std::vector<Vec3>> randomPoints(std::span<const LobeRegion> regions, std::size_t count,
                                            std::uint64_t seed, const Progress& progress = {});

/// The gap between terminal `ends` and random `points` of `regions`. All ends count as neighbours;
/// those that lie inside the regions count for the spacing. Nothing if there is no point, or no end
/// lies inside.
std::optional<Gap> gap(std::span<const Vec3> ends, std::span<const LobeRegion> regions,
                       std::span<const Vec3> points, const Progress& progress = {});

}  // namespace pneuma
