#include "io/detail/exact_points.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace pneuma {
namespace {

std::size_t hashOf(const Vec3& p) {
  std::uint64_t hash = 0;
  for (const double coordinate : {p.x(), p.y(), p.z()}) {
    // Adding 0 turns -0 into 0. Multiply and shift as in splitmix64, so that coordinates of few
    // digits (32-bit floats) spread over all bits.
    hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0xBF58476D1CE4E5B9U;
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

}  // namespace

std::uint32_t ExactPoints::add(const Vec3& p) {
  if (2 * points_.size() >= slots_.size()) grow();
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = hashOf(p) & mask;; slot = (slot + 1) & mask) {
    if (slots_[slot] == 0) {
      points_.push_back(p);
      slots_[slot] = static_cast<std::uint32_t>(points_.size());
      return slots_[slot] - 1;
    }
    if (points_[slots_[slot] - 1] == p) return slots_[slot] - 1;
  }
}

void ExactPoints::grow() {
  slots_.assign(std::max<std::size_t>(1024, 4 * points_.size()), 0);
  slots_.resize(std::bit_ceil(slots_.size()), 0);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    std::size_t slot = hashOf(points_[i]) & mask;
    while (slots_[slot] != 0) slot = (slot + 1) & mask;
    slots_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

}  // namespace pneuma
