#include "core/domain.h"

#include <algorithm>
#include <cmath>

namespace pneuma {

bool Domain::containsSegment(const Vec3& a, const Vec3& b) const {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / 0.5)));
  for (int i = 0; i <= steps; ++i) {
    if (!contains(a + (b - a) * (static_cast<double>(i) / steps))) return false;
  }
  return true;
}

}  // namespace pneuma
