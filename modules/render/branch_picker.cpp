#include "render/branch_picker.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pneuma {
namespace {

/// The best branch so far for one pixel.
class Nearest {
 public:
  Nearest(double x, double y, double tolerance) : pixel_(x, y), tolerance_(tolerance) {}

  void offer(std::size_t branch, const Vec3& a, const Vec3& b, double radiusMm,
             const Projection& projection) {
    if (a.z() <= 0.0 || b.z() <= 0.0) return;
    const Eigen::Vector2d along = b.head<2>() - a.head<2>();
    const double length2 = along.squaredNorm();
    const double t = length2 > 0.0
                         ? std::clamp((pixel_ - a.head<2>()).dot(along) / length2, 0.0, 1.0)
                         : (a.z() < b.z() ? 0.0 : 1.0);
    const double off = (a.head<2>() + t * along - pixel_).norm();
    const double distance = a.z() + t * (b.z() - a.z());
    const double gap = off - radiusMm * projection.pixelsPerMm(distance);
    if (gap > tolerance_) return;
    const bool hit = gap <= 0.0;
    const double front = distance - radiusMm;
    const bool better = hit ? (!hit_ || front < front_) : (!hit_ && gap < gap_);
    if (!better) return;
    best_ = branch;
    hit_ = hit;
    front_ = front;
    gap_ = gap;
  }

  std::optional<std::size_t> best() const { return best_; }

 private:
  Eigen::Vector2d pixel_;
  double tolerance_;
  std::optional<std::size_t> best_;
  bool hit_ = false;
  double front_ = std::numeric_limits<double>::infinity();
  double gap_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Vec3 Projection::project(const Vec3& p) const {
  const auto row = [&](std::size_t r) {
    return clipFromWorld[4 * r] * p.x() + clipFromWorld[4 * r + 1] * p.y() +
           clipFromWorld[4 * r + 2] * p.z() + clipFromWorld[4 * r + 3];
  };
  // The last row of a perspective matrix gives the distance along the line of sight.
  const double w = row(3);
  if (w <= 0.0) return {0.0, 0.0, w};
  return {(row(0) / w + 1.0) * 0.5 * width, (row(1) / w + 1.0) * 0.5 * height, w};
}

double Projection::pixelsPerMm(double distance) const {
  const double scale = std::hypot(clipFromWorld[4], clipFromWorld[5], clipFromWorld[6]);
  return scale * 0.5 * height / distance;
}

std::optional<std::size_t> branchUnder(const AirwayTree& tree, const std::vector<bool>& visible,
                                       double radiusScale, const Projection& projection, double x,
                                       double y, double tolerance) {
  Nearest nearest(x, y, tolerance);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!visible[i]) continue;
    const Branch& branch = tree[i];
    Vec3 last = projection.project(branch.proximal);
    for (const CentrelinePoint& point : branch.via) {
      const Vec3 next = projection.project(point.position);
      nearest.offer(i, last, next, point.radiusMm * radiusScale, projection);
      last = next;
    }
    const double radius = branch.via.empty() ? branch.radiusMm : branch.via.back().radiusMm;
    nearest.offer(i, last, projection.project(branch.distal), radius * radiusScale, projection);
  }
  return nearest.best();
}

}  // namespace pneuma
