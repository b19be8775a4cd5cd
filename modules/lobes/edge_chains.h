#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "lobes/region_complex.h"

namespace pneuma {

/// New points upon edges, any number upon each, in their order.
class EdgeChains {
 public:
  /// Takes the points from triangles that were divided: what lies between the corners of `parent`
  /// along the border of its parts.
  void add(const std::array<std::uint32_t, 3>& parent,
           std::span<const std::array<std::uint32_t, 3>> parts);

  /// The points from `a` to `b`, ends not among them; empty if the edge was not divided.
  std::vector<std::uint32_t> between(std::uint32_t a, std::uint32_t b) const;

 private:
  std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> chains_;  ///< from the lower
};

/// The parts of a triangle with points upon its edges, turned as it is. Itself where there are
/// none.
std::vector<std::array<std::uint32_t, 3>> dividedAlong(
    const EdgeChains& chains, const std::array<std::uint32_t, 3>& triangle);

}  // namespace pneuma
