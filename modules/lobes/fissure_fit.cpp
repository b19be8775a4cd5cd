#include "lobes/fissure_fit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Dense>

#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

/// Second to first eigenvalue of the points' spread, below which they lie on a line.
constexpr double LineShare = 1e-4;

double weightOf(std::span<const double> weights, std::size_t i) {
  return weights.empty() ? 1.0 : weights[i];
}

/// Thin-plate spline through (knot, value): weights of the knots and the plane below them.
struct Spline {
  std::vector<double> weights;
  std::array<double, 3> plane{};
};

Spline splineOf(const std::vector<Vec2>& knots, const std::vector<double>& values,
                std::span<const double> pointWeights, double smoothness) {
  const auto n = static_cast<Eigen::Index>(knots.size());
  const auto knot = [&](Eigen::Index i) { return knots[static_cast<std::size_t>(i)]; };
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double r2 = (knot(i) - knot(j)).squaredNorm();
      system(i, j) = system(j, i) = r2 > 0.0 ? 0.5 * r2 * std::log(r2) : 0.0;
    }
    system(i, i) = smoothness / weightOf(pointWeights, static_cast<std::size_t>(i));
    system(i, n) = system(n, i) = 1.0;
    system(i, n + 1) = system(n + 1, i) = knot(i).x();
    system(i, n + 2) = system(n + 2, i) = knot(i).y();
    right(i) = values[static_cast<std::size_t>(i)];
  }
  const Eigen::VectorXd solved = system.colPivHouseholderQr().solve(right);
  Spline spline;
  spline.weights.assign(solved.data(), solved.data() + n);
  spline.plane = {solved(n), solved(n + 1), solved(n + 2)};
  return spline;
}

}  // namespace

BestPlane bestPlane(std::span<const Vec3> points, std::span<const double> weights) {
  if (points.size() < 3) {
    throw InvalidInput("a fissure needs three points at least; there are " +
                       std::to_string(points.size()));
  }
  BestPlane plane;
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = weightOf(weights, i);
    if (!points[i].allFinite() || !(weight > 0.0)) {
      throw InvalidInput("point " + std::to_string(i + 1) +
                         " of a fissure is no place: its coordinates must be numbers, its weight "
                         "positive");
    }
    plane.centre += weight * points[i];
    sum += weight;
  }
  plane.centre /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 d = points[i] - plane.centre;
    covariance += weightOf(weights, i) / sum * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(covariance);
  const Vec3 values = spread.eigenvalues();
  if (!(values.y() > LineShare * values.z())) {
    throw InvalidInput("the points of a fissure lie on one line; set one beside it");
  }
  plane.axes[2] = spread.eigenvectors().col(0);
  if (plane.axes[2].dot(Vec3(0.0, -0.7, 1.0)) < 0.0) plane.axes[2] = -plane.axes[2];
  plane.axes[0] = spread.eigenvectors().col(2);
  plane.axes[1] = plane.axes[2].cross(plane.axes[0]);
  plane.scale = std::sqrt(values.sum());
  return plane;
}

HeightSurface fitFissure(std::span<const Vec3> points, const FissureFitOptions& options,
                         std::span<const double> weights) {
  requireValid(options);
  const BestPlane plane = bestPlane(points, weights);
  HeightSurface flat;
  flat.centre = plane.centre;
  flat.axes = plane.axes;
  flat.scale = plane.scale;
  return bentThrough(flat, points, options, weights);
}

HeightSurface bentThrough(const HeightSurface& prior, std::span<const Vec3> points,
                          const FissureFitOptions& options, std::span<const double> weights) {
  requireValid(options);
  bestPlane(points, weights);  // refuses what no surface goes through
  HeightSurface surface = prior;
  std::vector<double> beside;
  for (const Vec3& p : points) {
    surface.knots.emplace_back(prior.planar(p) / prior.scale);
    beside.push_back(prior.height(p));
  }
  const Spline spline = splineOf(surface.knots, beside, weights, options.smoothness);
  for (std::size_t c = 0; c < 3; ++c) surface.quadratic[c] += spline.plane[c];
  surface.weights = spline.weights;
  if (points.size() == 3) {  // exactly the plane
    surface.knots.clear();
    surface.weights.clear();
  }
  return surface;
}

std::vector<double> leaveOneOut(std::span<const Vec3> points, const FissureFitOptions& options) {
  if (points.size() < 4) return {};
  std::vector<double> away(points.size(), 0.0);
  parallelFor(points.size(), [&](std::size_t i) {
    std::vector<Vec3> others(points.begin(), points.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    try {
      away[i] = std::abs(fitFissure(others, options).distance(points[i]));
    } catch (const InvalidInput&) {
      away[i] = 0.0;  // the others lie on one line
    }
  });
  return away;
}

}  // namespace pneuma
