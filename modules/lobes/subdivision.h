#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "lobes/region_complex.h"

namespace pneuma {

/// New points upon edges of a complex.
class EdgePoints {
 public:
  /// @param points of the complex that edges have
  explicit EdgePoints(std::size_t points) : touched_(points, 0) {}

  /// The point upon the edge, or null.
  const std::uint32_t* find(std::uint32_t a, std::uint32_t b) const {
    if (a >= touched_.size() || b >= touched_.size() || !touched_[a] || !touched_[b])
      return nullptr;
    const auto found = pointOf_.find(key(a, b));
    return found == pointOf_.end() ? nullptr : &found->second;
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t point) {
    touched_[a] = touched_[b] = 1;
    pointOf_[key(a, b)] = point;
  }

  bool empty() const { return pointOf_.empty(); }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return a < b ? (std::uint64_t{a} << 32U) | b : (std::uint64_t{b} << 32U) | a;
  }

  std::vector<char> touched_;
  std::unordered_map<std::uint64_t, std::uint32_t> pointOf_;
};

/// Divides every triangle that has a new point upon an edge into two, three or four; the regions
/// beside it stay. Nothing moves: the surfaces are what they were.
/// @param parentOf the triangle that each one came from, as stored before; may be null
void subdivide(RegionComplex& complex, const EdgePoints& edgePoints,
               std::vector<std::uint32_t>* parentOf = nullptr);

}  // namespace pneuma
