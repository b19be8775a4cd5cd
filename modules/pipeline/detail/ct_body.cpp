#include "pipeline/detail/ct_body.h"

#include <algorithm>
#include <cmath>

namespace pneuma {

Box3 endlessBox() { return {Vec3::Constant(-1e9), Vec3::Constant(1e9)}; }

Box3 widened(const Box3& box, double marginMm) {
  const Vec3 margin = Vec3::Constant(marginMm);
  return {box.min() - margin, box.max() + margin};
}

double CtTube::level(const Vec3& p) const {
  const Vec3 way = to - from;
  const double squared = way.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - from).dot(way) / squared, 0.0, 1.0) : 0.0;
  const double radius = fromRadiusMm + t * (toRadiusMm - fromRadiusMm);
  const double slope = squared > 0.0 ? (toRadiusMm - fromRadiusMm) / std::sqrt(squared) : 0.0;
  return (radius - (p - from - t * way).norm()) / (1.0 + std::abs(slope));
}

Box3 CtTube::box() const {
  Box3 ends(from.cwiseMin(to), from.cwiseMax(to));
  return widened(ends, std::max(fromRadiusMm, toRadiusMm));
}

CtShape tubeShape(const CtTube& tube, double hu) {
  CtShape shape;
  shape.box = tube.box();
  shape.level = [tube](const Vec3& p) { return tube.level(p); };
  shape.hu = hu;
  return shape;
}

}  // namespace pneuma
