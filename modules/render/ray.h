#pragma once

#include <optional>

#include "core/math.h"

namespace pneuma {

/// Where a straight line meets a triangle.
struct RayHit {
  double share = 0.0;  ///< of the way
  double b = 0.0;      ///< weights of the second and the third corner there
  double c = 0.0;
};

/// Where a way meets the triangle (a, b, c), if it does (Moeller and Trumbore 1997).
std::optional<RayHit> hit(const Vec3& from, const Vec3& way, const Vec3& a, const Vec3& b,
                          const Vec3& c);

}  // namespace pneuma
