#include "render/ray.h"

namespace pneuma {

std::optional<RayHit> hit(const Vec3& from, const Vec3& way, const Vec3& a, const Vec3& b,
                          const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 across = way.cross(ac);
  const double volume = ab.dot(across);
  if (volume == 0.0) return std::nullopt;
  const Vec3 offset = from - a;
  const double u = offset.dot(across) / volume;
  if (u < 0.0 || u > 1.0) return std::nullopt;
  const Vec3 beside = offset.cross(ab);
  const double v = way.dot(beside) / volume;
  if (v < 0.0 || u + v > 1.0) return std::nullopt;
  const double share = ac.dot(beside) / volume;
  if (share < 0.0 || share > 1.0) return std::nullopt;
  return RayHit{share, u, v};
}

}  // namespace pneuma
