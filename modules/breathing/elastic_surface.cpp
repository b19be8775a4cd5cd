#include "breathing/elastic_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "breathing/screened_laplacian.h"
#include "breathing/surface_points.h"
#include "core/error.h"

namespace pneuma {
namespace {

constexpr std::size_t ProxyPoints = 30'000;  // 2 mm apart on a lung

/// By the median; 1 everywhere without any.
std::vector<double> relative(std::span<const double> stiffness, std::size_t points) {
  if (stiffness.empty()) return std::vector<double>(points, 1.0);
  if (stiffness.size() != points) {
    throw InvalidInput("the surface has " + std::to_string(points) + " points, but there are " +
                       std::to_string(stiffness.size()) + " stiffnesses; give one for each point");
  }
  std::vector<double> values(stiffness.begin(), stiffness.end());
  for (const double e : values) {
    if (!(e > 0.0) || !std::isfinite(e)) {
      throw InvalidInput("a stiffness is " + std::to_string(e) + "; it must be above 0");
    }
  }
  std::vector<double> sorted = values;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(points / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (double& e : values) e /= *middle;
  return values;
}

std::vector<double> product(const std::vector<double>& a, std::span<const double> b) {
  std::vector<double> both(a.size());
  for (std::size_t n = 0; n < both.size(); ++n) both[n] = a[n] * b[n];
  return both;
}

}  // namespace

ElasticSurface::ElasticSurface(const TriangleMesh& surface, std::span<const double> given,
                               const ElasticOptions& options)
    : areas_(pointAreas(surface)) {
  if (!(std::accumulate(areas_.begin(), areas_.end(), 0.0) > 0.0)) {
    throw InvalidInput("the surface of a lung has no area; examine it with 'pneuma info'");
  }
  matrix_ = screenedLaplacian(surface, areas_, relative(given, areas_.size()), options.lengthMm);
  if (areas_.size() <= options.mostPoints) return;
  proxy_ = surfaceProxy(surface, matrix_, std::min(ProxyPoints, options.mostPoints / 2));
  matrix_ = proxy_->condensed(matrix_);
}

std::vector<double> ElasticSurface::response(std::span<const double> force,
                                             const SolveOptions& options,
                                             const Progress& progress) const {
  if (force.size() != areas_.size()) {
    throw InvalidInput("the surface has " + std::to_string(areas_.size()) +
                       " points, but there are " + std::to_string(force.size()) + " forces");
  }
  const std::vector<double> applied = product(areas_, force);
  if (!proxy_) return solve(matrix_, applied, options, progress);
  return proxy_->atFinePoints(solve(matrix_, proxy_->gathered(applied), options, progress));
}

}  // namespace pneuma
