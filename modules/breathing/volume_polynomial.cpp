#include "breathing/volume_polynomial.h"

#include <algorithm>
#include <cmath>

namespace pneuma {
namespace {

/// Six times the volume of the tetrahedron with the origin.
double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

constexpr double LeastHeightMm = 0.01;  // of triangles that can be told from slivers

/// A sum that keeps what single additions lose.
class ExactSum {
 public:
  void add(double value) {
    const double sum = total_ + value;
    lost_ += std::abs(total_) >= std::abs(value) ? (total_ - sum) + value : (value - sum) + total_;
    total_ = sum;
  }

  double value() const { return total_ + lost_; }

 private:
  double total_ = 0.0;
  double lost_ = 0.0;
};

/// The smallest positive root of a + b s + c s^2 with a > 0.
std::optional<double> firstRoot(double a, double b, double c) {
  if (c == 0.0) return b < 0.0 ? std::optional(-a / b) : std::nullopt;
  const double inside = b * b - 4.0 * a * c;
  if (inside < 0.0) return std::nullopt;
  const double q = -0.5 * (b + std::copysign(std::sqrt(inside), b));
  std::optional<double> least;
  for (const double root : {q / c, q == 0.0 ? 0.0 : a / q}) {
    if (root > 0.0 && (!least || root < *least)) least = root;
  }
  return least;
}

}  // namespace

VolumePolynomial volumePolynomial(const TriangleMesh& surface, std::span<const Vec3> displacement) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : surface.points) centre += p;
  if (!surface.points.empty()) centre /= static_cast<double>(surface.points.size());
  std::array<ExactSum, 4> sums;
  for (const auto& [i, j, k] : surface.triangles) {
    const Vec3 p = surface.points[i] - centre;
    const Vec3 q = surface.points[j] - centre;
    const Vec3 r = surface.points[k] - centre;
    const Vec3& u = displacement[i];
    const Vec3& v = displacement[j];
    const Vec3& w = displacement[k];
    sums[0].add(triple(p, q, r) / 6.0);
    sums[1].add((triple(u, q, r) + triple(p, v, r) + triple(p, q, w)) / 6.0);
    sums[2].add((triple(u, v, r) + triple(u, q, w) + triple(p, v, w)) / 6.0);
    sums[3].add(triple(u, v, w) / 6.0);
  }
  return {{sums[0].value(), sums[1].value(), sums[2].value(), sums[3].value()}};
}

double movedVolumeMm3(const TriangleMesh& surface, std::span<const Vec3> displacement, double s) {
  if (surface.points.empty()) return 0.0;
  const auto at = [&](std::size_t n) -> Vec3 { return surface.points[n] + s * displacement[n]; };
  const Vec3 origin = at(0);
  double six = 0.0;
  for (const auto& [a, b, c] : surface.triangles) {
    six += triple(at(a) - origin, at(b) - origin, at(c) - origin);
  }
  return six / 6.0;
}

std::optional<double> scaleForVolume(const VolumePolynomial& volume, double wantedMm3) {
  if (!(wantedMm3 > 0.0)) return std::nullopt;
  double s = 0.0;
  for (int n = 0; n < 50; ++n) {
    const double slope = volume.slope(s);
    if (!(slope > 0.0)) return std::nullopt;
    const double step = (wantedMm3 - volume.at(s)) / slope;
    s += step;
    if (!std::isfinite(s)) return std::nullopt;
    if (std::abs(step) <= 1e-15 * std::max(1.0, std::abs(s))) break;
  }
  constexpr int Steps = 32;
  for (int n = 1; n <= Steps; ++n) {
    if (!(volume.slope(s * n / Steps) > 0.0)) return std::nullopt;
  }
  const bool reached = std::abs(volume.at(s) - wantedMm3) <= 1e-9 * wantedMm3;
  return reached ? std::optional(s) : std::nullopt;
}

std::optional<double> foldLimit(const TriangleMesh& surface, std::span<const Vec3> displacement,
                                double towards) {
  const double sign = towards < 0.0 ? -1.0 : 1.0;
  std::optional<double> least;
  for (const auto& [i, j, k] : surface.triangles) {
    const Vec3 e = surface.points[j] - surface.points[i];
    const Vec3 f = surface.points[k] - surface.points[i];
    const Vec3 de = sign * (displacement[j] - displacement[i]);
    const Vec3 df = sign * (displacement[k] - displacement[i]);
    const Vec3 area = e.cross(f);
    const double longest = std::max({e.norm(), f.norm(), (e - f).norm()});
    if (area.norm() <= LeastHeightMm * longest) continue;
    const auto root =
        firstRoot(area.squaredNorm(), area.dot(de.cross(f) + e.cross(df)), area.dot(de.cross(df)));
    if (root && (!least || *root < *least)) least = root;
  }
  return least ? std::optional(sign * *least) : std::nullopt;
}

}  // namespace pneuma
