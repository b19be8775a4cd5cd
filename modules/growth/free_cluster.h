#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "core/progress.h"

namespace pneuma {

/// Diffusion-limited aggregation in free space around one particle at the origin (Witten and Sander
/// 1981), in order of arrival, in units of the lattice; z = 0 in two dimensions.
///
/// Walkers start at random from a circle or sphere around the cluster. One that goes farther comes
/// back to it, in three dimensions only with probability radius / distance, by the exact law of
/// where Brownian motion hits a circle or a sphere from outside.
/// @throws Cancelled
template <int D>
std::vector<Vec3> freeCluster(std::size_t count, std::uint64_t seed, const Progress& progress = {});

extern template std::vector<Vec3> freeCluster<2>(std::size_t, std::uint64_t, const Progress&);
extern template std::vector<Vec3> freeCluster<3>(std::size_t, std::uint64_t, const Progress&);

}  // namespace pneuma
