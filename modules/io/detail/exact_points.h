#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// Points numbered so that the same coordinates have the same number. Only exactly equal
/// coordinates count as the same; 0 and -0 are.
class ExactPoints {
 public:
  /// The number of the point with these coordinates, which is added if there is none.
  std::uint32_t add(const Vec3& p);

  const std::vector<Vec3>& points() const { return points_; }

  std::vector<Vec3> take() && { return std::move(points_); }

 private:
  void grow();

  std::vector<Vec3> points_;
  std::vector<std::uint32_t> slots_;  ///< open addressing: number of a point + 1, 0 if free
};

}  // namespace pneuma
