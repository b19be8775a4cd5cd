#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math.h"

namespace pneuma {

/// A point in whole quanta. Eight bytes, so that it is moved and compared as one.
struct alignas(8) QuantisedPoint {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::int16_t z = 0;
  std::int16_t unused = 0;  ///< always 0
};

/// Component-wise sum of points, exact.
struct QuantisedSum {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;

  friend QuantisedSum operator-(const QuantisedSum& a, const QuantisedSum& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};

/// A plane in quanta: points with normal . q < limit lie in front.
struct QuantisedPlane {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::int16_t z = 0;
  std::int32_t limit = 0;

  /// @param normal unit vector
  /// @param through a point of the plane, in quanta
  QuantisedPlane(const Vec3& normal, const Vec3& through);
};

QuantisedSum sumOf(const QuantisedPoint* points, std::size_t count);

/// Moves the points in front of the plane to the front of the array; both parts keep their order.
/// Returns how many are in front. Integer arithmetic only: the same answer on every machine.
/// @param scratch room for `count` points
std::size_t partition(QuantisedPoint* points, std::size_t count, const QuantisedPlane& plane,
                      QuantisedPoint* scratch);

}  // namespace pneuma
