#include "breathing/strain_assignment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "breathing/surface_points.h"
#include "core/error.h"

namespace pneuma {
namespace {

constexpr double Middle = 0.5;
constexpr double LowestShare = 0.6;               // of the lung's height, from the apex
constexpr double FacesDown = 0.7071067811865476;  // cosine of 45 degrees

constexpr std::array<StrainPoint, 3> CopdPoints = {{{0.0, 0.2}, {0.5, 0.16}, {1.0, 0.1}}};
constexpr std::array<StrainPoint, 3> FibrosisPoints = {{{0.0, 0.1}, {0.5, 0.09}, {1.0, 0.075}}};
constexpr std::array<StrainPoint, 4> PalsyPoints = {
    {{0.0, 0.05}, {0.25, 0.12}, {0.5, 0.2}, {1.0, 0.075}}};
constexpr std::array<StrainPoint, 3> DyspneaPoints = {{{0.0, 0.4}, {0.5, 0.28}, {1.0, 0.2}}};
constexpr std::array<StrainPoint, 4> ObesityPoints = {
    {{0.0, 0.1}, {0.3, 0.15}, {0.5, 0.2}, {1.0, 0.15}}};

/// 2 sigma^2 of the gaussian that falls from the table's second to its third point.
double twiceVariance() {
  const double half = PublishedStrain[2].r - PublishedStrain[1].r;
  return half * half / std::log(PublishedStrain[1].strain / PublishedStrain[2].strain);
}

double publishedAt(double r) {
  const double decay = std::numbers::ln2 / Middle;
  if (r <= Middle) return PublishedStrain[0].strain * std::exp(-decay * r);
  return PublishedStrain[1].strain * std::exp(-(r - Middle) * (r - Middle) / twiceVariance());
}

double publishedSlope(double r) {
  if (r < Middle) return -std::numbers::ln2 / Middle * publishedAt(r);
  return -2.0 * (r - Middle) / twiceVariance() * publishedAt(r);
}

/// Slopes at the points with which the cubics between them rise and fall as the points do.
std::vector<double> monotoneSlopes(std::span<const StrainPoint> points) {
  const std::size_t last = points.size() - 1;
  std::vector<double> secants(last);
  for (std::size_t n = 0; n < last; ++n) {
    secants[n] = (points[n + 1].strain - points[n].strain) / (points[n + 1].r - points[n].r);
  }
  std::vector<double> slopes(points.size());
  slopes.front() = secants.front();
  slopes.back() = secants.back();
  for (std::size_t n = 1; n < last; ++n) {
    const bool turns = secants[n - 1] * secants[n] <= 0.0;
    slopes[n] = turns ? 0.0 : 0.5 * (secants[n - 1] + secants[n]);
  }
  for (std::size_t n = 0; n < last; ++n) {
    if (secants[n] == 0.0) {
      slopes[n] = slopes[n + 1] = 0.0;
      continue;
    }
    const double a = slopes[n] / secants[n];
    const double b = slopes[n + 1] / secants[n];
    const double circle = std::hypot(a, b);
    if (circle <= 3.0) continue;
    slopes[n] = 3.0 / circle * a * secants[n];
    slopes[n + 1] = 3.0 / circle * b * secants[n];
  }
  return slopes;
}

void requireCurve(std::span<const StrainPoint> points) {
  const auto wrong = [](const std::string& what) {
    throw InvalidInput("a curve of strain " + what +
                       "; it takes two or more points with r rising from 0 to 1 and strains above "
                       "0");
  };
  if (points.size() < 2) wrong("has " + std::to_string(points.size()) + " points");
  if (points.front().r != 0.0 || points.back().r != 1.0) {
    wrong("goes from r = " + std::to_string(points.front().r) + " to " +
          std::to_string(points.back().r));
  }
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (n > 0 && !(points[n].r > points[n - 1].r)) {
      wrong("goes back at its point " + std::to_string(n + 1));
    }
    if (!(points[n].strain > 0.0) || !std::isfinite(points[n].strain)) {
      wrong("has the strain " + std::to_string(points[n].strain) + " at its point " +
            std::to_string(n + 1));
    }
  }
}

}  // namespace

StrainCurve StrainCurve::published() { return StrainCurve(); }

StrainCurve::StrainCurve(std::span<const StrainPoint> points)
    : points_(points.begin(), points.end()) {
  requireCurve(points);
  slopes_ = monotoneSlopes(points);
}

std::size_t StrainCurve::intervalOf(double r) const {
  const auto after = std::ranges::upper_bound(points_, r, {}, &StrainPoint::r);
  const auto n = static_cast<std::size_t>(after - points_.begin());
  return std::clamp<std::size_t>(n, 1, points_.size() - 1) - 1;
}

double StrainCurve::at(double r) const {
  r = std::clamp(r, 0.0, 1.0);
  if (points_.empty()) return publishedAt(r);
  const std::size_t n = intervalOf(r);
  const double width = points_[n + 1].r - points_[n].r;
  const double t = (r - points_[n].r) / width;
  const double rise = t * t * (3.0 - 2.0 * t);
  return points_[n].strain * (1.0 - rise) + points_[n + 1].strain * rise +
         width * t * (1.0 - t) * (slopes_[n] * (1.0 - t) - slopes_[n + 1] * t);
}

double StrainCurve::slope(double r) const {
  if (r < 0.0 || r > 1.0) return 0.0;
  if (points_.empty()) return publishedSlope(r);
  const std::size_t n = intervalOf(r);
  const double width = points_[n + 1].r - points_[n].r;
  const double t = (r - points_[n].r) / width;
  return 6.0 * t * (1.0 - t) * (points_[n + 1].strain - points_[n].strain) / width +
         slopes_[n] * (1.0 - t) * (1.0 - 3.0 * t) - slopes_[n + 1] * t * (2.0 - 3.0 * t);
}

std::span<const StrainPoint> strainPoints(StrainPreset preset) {
  switch (preset) {
    case StrainPreset::Published:
    case StrainPreset::Smooth:
      return PublishedStrain;
    case StrainPreset::Copd:
      return CopdPoints;
    case StrainPreset::Fibrosis:
      return FibrosisPoints;
    case StrainPreset::Palsy:
      return PalsyPoints;
    case StrainPreset::Dyspnea:
      return DyspneaPoints;
    case StrainPreset::Obesity:
      break;
  }
  return ObesityPoints;
}

StrainCurve strainCurve(StrainPreset preset) {
  return preset == StrainPreset::Published ? StrainCurve::published()
                                           : StrainCurve(strainPoints(preset));
}

std::vector<std::uint32_t> diaphragmaticSurface(const TriangleMesh& surface) {
  const std::vector<Vec3> normals = pointNormals(surface);
  const Box3 box = bounds(surface);
  std::vector<std::uint32_t> found;
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    const double fromApex = (box.max().z() - surface.points[n].z()) / box.sizes().z();
    if (fromApex > LowestShare && -normals[n].z() >= FacesDown) {
      found.push_back(static_cast<std::uint32_t>(n));
    }
  }
  if (found.empty()) {
    throw InvalidInput(
        "no part of the lung's surface faces down in its lowest 40 %, so that no diaphragm is "
        "found; turn the surface outside out with 'pneuma repair', or choose the points of maximum "
        "deformation");
  }
  return found;
}

std::vector<double> initialStrain(const TriangleMesh& surface,
                                  std::span<const std::uint32_t> region, const StrainCurve& curve) {
  if (region.empty()) throw InvalidInput("the region of maximum deformation has no points");
  Vec3 centroid = Vec3::Zero();
  for (const std::uint32_t n : region) {
    if (n >= surface.points.size()) {
      throw InvalidInput("the region of maximum deformation names point " + std::to_string(n) +
                         " of a surface of " + std::to_string(surface.points.size()));
    }
    centroid += surface.points[n];
  }
  centroid /= static_cast<double>(region.size());
  double farthest = 0.0;
  for (const Vec3& p : surface.points) farthest = std::max(farthest, (p - centroid).norm());
  std::vector<double> strain;
  strain.reserve(surface.points.size());
  for (const Vec3& p : surface.points) {
    strain.push_back(curve.at(farthest > 0.0 ? (p - centroid).norm() / farthest : 0.0));
  }
  return strain;
}

}  // namespace pneuma
