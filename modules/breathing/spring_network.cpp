#include "breathing/spring_network.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

constexpr double LeastMm = 1.0;  // of a distance, as in the paper
constexpr double RegularValence = 6.0;
constexpr std::size_t BlockRows = 8192;

void requireAsMany(std::size_t given, std::size_t points, const char* what) {
  if (given == points) return;
  throw InvalidInput("the surface has " + std::to_string(points) + " points, but there are " +
                     std::to_string(given) + " " + what + "; give one for each point");
}

std::vector<double> normalised(std::span<const double> modulus, std::size_t points,
                               bool normalise) {
  if (modulus.empty()) return std::vector<double>(points, 1.0);
  requireAsMany(modulus.size(), points, "moduli");
  double logarithms = 0.0;
  for (const double e : modulus) {
    if (!(e > 0.0) || !std::isfinite(e)) {
      throw InvalidInput("a Young's modulus is " + std::to_string(e) + "; it must be above 0");
    }
    logarithms += std::log(e);
  }
  const double mean = normalise ? std::exp(logarithms / static_cast<double>(points)) : 1.0;
  std::vector<double> stiffness;
  stiffness.reserve(points);
  for (const double e : modulus) stiffness.push_back(e / mean);
  return stiffness;
}

}  // namespace

double SpringNetwork::valenceShare(std::uint32_t mass) const {
  const auto edges = static_cast<double>(matrix_.first[mass + 1] - matrix_.first[mass]);
  return evenValence_ ? edges / RegularValence : 1.0;
}

SpringNetwork::Spring SpringNetwork::springBetween(std::uint32_t a, std::uint32_t b) const {
  const double half = std::max(LeastMm, 0.5 * (points_[a] - points_[b]).norm());
  return {{a, b}, {half * valenceShare(a), half * valenceShare(b)}};
}

SpringNetwork::SpringNetwork(const TriangleMesh& surface, std::span<const double> modulus,
                             const SpringNetworkOptions& options)
    : points_(surface.points),
      stiffness_(normalised(modulus, surface.points.size(), options.normalise)),
      evenValence_(options.evenValence),
      matrix_(edgeMatrix(surface)) {
  if (points_.empty()) throw InvalidInput("a surface without points has no springs");
  const std::size_t rows = masses();
  parallelFor((rows + BlockRows - 1) / BlockRows, [&](std::size_t block) {
    const std::size_t end = std::min(rows, (block + 1) * BlockRows);
    for (std::size_t row = block * BlockRows; row < end; ++row) {
      const auto a = static_cast<std::uint32_t>(row);
      double diagonal = 1.0 / (stiffness_[a] * stiffness_[a]);
      for (std::size_t at = matrix_.first[a]; at < matrix_.first[a + 1]; ++at) {
        const std::uint32_t b = matrix_.column[at];
        const Spring spring = springBetween(a, b);
        const double s = expandability(spring);
        const double toA = s / (stiffness_[a] * spring.distance[0]);
        const double toB = s / (stiffness_[b] * spring.distance[1]);
        const double all = s * s + toA + toB;
        // The spring's row is solved for its z and put into those of its masses.
        matrix_.value[at] = -toA * toB / all;
        diagonal += toA * (s * s + toB) / all;
      }
      matrix_.diagonal[a] = diagonal;
    }
  });
}

std::vector<SpringNetwork::Spring> SpringNetwork::springNodes() const {
  std::vector<Spring> nodes;
  nodes.reserve(springs());
  for (std::uint32_t a = 0; a < masses(); ++a) {
    for (std::size_t at = matrix_.first[a]; at < matrix_.first[a + 1]; ++at) {
      if (matrix_.column[at] > a) nodes.push_back(springBetween(a, matrix_.column[at]));
    }
  }
  return nodes;
}

std::vector<double> SpringNetwork::forces(std::span<const double> force,
                                          const SolveOptions& options,
                                          const Progress& progress) const {
  requireAsMany(force.size(), masses(), "forces");
  std::vector<double> kept = solve(matrix_, force, options, progress);
  for (std::size_t n = 0; n < kept.size(); ++n) kept[n] /= stiffness_[n] * stiffness_[n];
  return kept;
}

std::vector<double> SpringNetwork::springForces(std::span<const double> forces) const {
  std::vector<double> kept;
  kept.reserve(springs());
  for (const Spring& spring : springNodes()) {
    const double s = expandability(spring);
    double all = s * s;
    double sum = 0.0;
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint32_t mass = spring.mass[end];
      const double conductance = s / (stiffness_[mass] * spring.distance[end]);
      all += conductance;
      sum += conductance * stiffness_[mass] * stiffness_[mass] * forces[mass];
    }
    kept.push_back(s * s * sum / all);
  }
  return kept;
}

std::vector<double> SpringNetwork::appliedFor(std::span<const double> forces) const {
  requireAsMany(forces.size(), masses(), "forces");
  std::vector<double> z(forces.begin(), forces.end());
  for (std::size_t n = 0; n < z.size(); ++n) z[n] *= stiffness_[n] * stiffness_[n];
  return matrix_.times(z);
}

}  // namespace pneuma
