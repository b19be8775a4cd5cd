#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"
#include "core/progress.h"

namespace pneuma {

/// Square of the distance from every voxel to the nearest one that is set, exact but for rounding,
/// mm^2; infinite beyond `limitMm` and where none is set.
///
/// Separable lower envelopes of parabolas (Felzenszwalb and Huttenlocher 2012, "Distance transforms
/// of sampled functions"), along i, j and k in turn; what is beyond the limit takes no part.
/// @param set one byte a voxel, i fastest, nonzero where set
/// @param spacing mm
/// @param progress for stopping alone
/// @throws Cancelled
std::vector<float> squaredDistances(std::span<const std::uint8_t> set,
                                    const std::array<int, 3>& size, const Vec3& spacing,
                                    double limitMm, const Progress& progress = {});

}  // namespace pneuma
