#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/math.h"

namespace pneuma {

/// For tables of points that are equal to the last bit.
struct PointHash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t hash = 0;
    for (const double x : {p.x(), p.y(), p.z()}) {
      // + 0.0 so that -0 and 0, which are equal, have one hash.
      hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

}  // namespace pneuma
