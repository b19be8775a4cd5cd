#include "core/domain.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pneuma {

bool Domain::containsSegment(const Vec3& a, const Vec3& b) const {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / 0.5)));
  for (int i = 0; i <= steps; ++i) {
    if (!contains(a + (b - a) * (static_cast<double>(i) / steps))) return false;
  }
  return true;
}

bool Domain::containsBox(const Box3& box) const {
  const Vec3 centre = box.center();
  return contains(centre) && distanceToWall(centre) >= box.diagonal().norm() / 2.0;
}

std::uint32_t Domain::insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const {
  std::uint32_t inside = 0;
  for (std::uint32_t left = wanted; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    if (contains(first + Vec3(i * stepMm, 0.0, 0.0))) inside |= 1U << i;
  }
  return inside;
}

double Domain::exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const {
  return exitByMarching(p, direction, farthestMm,
                        [this](const Vec3& at) { return distanceToWall(at); });
}

double Domain::exitByMarching(const Vec3& p, const Vec3& direction, double farthestMm,
                              const std::function<double(const Vec3&)>& clearanceMm) const {
  constexpr double NearStepMm = 0.5;
  constexpr double PrecisionMm = 1e-3;
  double inside = 0.0;
  double outside = 0.0;
  while (true) {
    if (inside >= farthestMm) return farthestMm;
    const double step = std::max(clearanceMm(p + inside * direction), NearStepMm);
    outside = std::min(inside + step, farthestMm);
    if (!contains(p + outside * direction)) break;
    inside = outside;
  }
  while (outside - inside > PrecisionMm) {
    const double middle = (inside + outside) / 2.0;
    (contains(p + middle * direction) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace pneuma
