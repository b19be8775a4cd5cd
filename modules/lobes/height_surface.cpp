#include "lobes/height_surface.h"

#include <cmath>

namespace pneuma {

double HeightSurface::lift(const Vec2& uv) const {
  const double a = uv.x() / scale;
  const double b = uv.y() / scale;
  double w = quadratic[0] + quadratic[1] * a + quadratic[2] * b + quadratic[3] * a * a +
             quadratic[4] * a * b + quadratic[5] * b * b;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double da = a - knots[i].x();
    const double db = b - knots[i].y();
    const double r2 = da * da + db * db;
    if (r2 > 0.0) w += 0.5 * weights[i] * r2 * std::log(r2);
  }
  return w;
}

Vec2 HeightSurface::slope(const Vec2& uv) const {
  const double a = uv.x() / scale;
  const double b = uv.y() / scale;
  Vec2 slope(quadratic[1] + 2.0 * quadratic[3] * a + quadratic[4] * b,
             quadratic[2] + quadratic[4] * a + 2.0 * quadratic[5] * b);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const Vec2 d(a - knots[i].x(), b - knots[i].y());
    const double r2 = d.squaredNorm();
    if (r2 > 0.0) slope += weights[i] * (std::log(r2) + 1.0) * d;
  }
  return slope / scale;
}

Vec3 HeightSurface::normalAt(const Vec2& uv) const {
  const Vec2 along = slope(uv);
  return (axes[2] - along.x() * axes[0] - along.y() * axes[1]).normalized();
}

double HeightSurface::distance(const Vec3& p) const {
  const Vec2 uv = planar(p);
  return ((p - centre).dot(axes[2]) - lift(uv)) / std::sqrt(1.0 + slope(uv).squaredNorm());
}

}  // namespace pneuma
