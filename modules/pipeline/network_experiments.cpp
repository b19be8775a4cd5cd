#include "pipeline/network_experiments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "breathing/pitcher_catcher.h"
#include "breathing/spring_network.h"
#include "core/random.h"

namespace pneuma {
namespace {

constexpr int PlaneSide = 21;
constexpr double EdgeMm = 2.0;  // half of it is the paper's least distance of 1
constexpr int DiscRings = 10;
constexpr int DiscSpokes = 36;
constexpr double NearestPercent = 0.001;  // how near approaches are followed
constexpr double Light = 0.3;

double rootMeanSquare(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double differencePercent(std::span<const double> values, std::span<const double> rest) {
  std::vector<double> off(rest.size());
  for (std::size_t n = 0; n < off.size(); ++n) off[n] = values[n] - rest[n];
  return 100.0 * rootMeanSquare(off) / rootMeanSquare(rest);
}

TriangleMesh plane() {
  TriangleMesh mesh;
  const auto at = [](int x, int y) { return static_cast<std::uint32_t>(y * PlaneSide + x); };
  for (int y = 0; y < PlaneSide; ++y) {
    for (int x = 0; x < PlaneSide; ++x) mesh.points.emplace_back(EdgeMm * x, EdgeMm * y, 0.0);
  }
  for (int y = 0; y + 1 < PlaneSide; ++y) {
    for (int x = 0; x + 1 < PlaneSide; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

TriangleMesh disc() {
  TriangleMesh mesh;
  mesh.points.emplace_back(0.0, 0.0, 0.0);
  const auto at = [](int ring, int spoke) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * DiscSpokes + spoke % DiscSpokes);
  };
  for (int ring = 1; ring <= DiscRings; ++ring) {
    for (int spoke = 0; spoke < DiscSpokes; ++spoke) {
      const double angle = 2.0 * std::numbers::pi * spoke / DiscSpokes;
      mesh.points.emplace_back(EdgeMm * ring * std::cos(angle), EdgeMm * ring * std::sin(angle),
                               0.0);
    }
  }
  for (int spoke = 0; spoke < DiscSpokes; ++spoke) {
    mesh.triangles.push_back({0, at(1, spoke), at(1, spoke + 1)});
    for (int ring = 1; ring < DiscRings; ++ring) {
      mesh.triangles.push_back({at(ring, spoke), at(ring + 1, spoke), at(ring + 1, spoke + 1)});
      mesh.triangles.push_back({at(ring, spoke), at(ring + 1, spoke + 1), at(ring, spoke + 1)});
    }
  }
  return mesh;
}

/// Rounds of pitching, each followed a little further than the one before.
Approach pitched(const SpringNetwork& network, std::span<const double> force,
                 std::span<const double> rest, double& conservation) {
  Approach approach;
  const auto nodes = static_cast<double>(network.masses() + network.springs());
  const double applied = std::accumulate(force.begin(), force.end(), 0.0);
  for (double tolerance = 2.0; tolerance > 1e-8; tolerance *= 0.75) {
    const PitchedForces forces =
        pitchForces(network, force, {.order = PitchOrder::Sweeps, .tolerance = tolerance});
    const double sweeps = std::ceil(static_cast<double>(forces.steps) / nodes);
    conservation = forces.sum() / applied;
    if (!approach.steps.empty() && sweeps == approach.steps.back()) continue;
    approach.steps.push_back(sweeps);
    approach.percent.push_back(
        differencePercent(std::span(forces.catcher).first(network.masses()), rest));
    if (approach.percent.back() < NearestPercent) break;
  }
  return approach;
}

/// Masses of 1 on the network's springs from rest, semi-implicit Euler steps as long as they can
/// be.
Approach damped(const SpringNetwork& network, std::span<const double> force,
                std::span<const double> rest, double ratio) {
  const PointMatrix& matrix = network.matrix();
  double stiffest = 0.0;  // bounds of the eigenvalues (Gershgorin)
  double softest = matrix.diagonal[0];
  for (std::size_t n = 0; n < matrix.size(); ++n) {
    double others = 0.0;
    for (std::size_t k = matrix.first[n]; k < matrix.first[n + 1]; ++k) {
      others += std::abs(matrix.value[k]);
    }
    stiffest = std::max(stiffest, matrix.diagonal[n] + others);
    softest = std::min(softest, matrix.diagonal[n] - others);
  }
  const double dt = 2.0 / std::sqrt(stiffest);
  const double damping = 2.0 * ratio * std::sqrt(softest);
  std::vector<double> position(rest.size(), 0.0);
  std::vector<double> velocity(rest.size(), 0.0);
  Approach approach;
  for (int step = 1; step <= 1000; ++step) {
    const std::vector<double> pulled = matrix.times(position);
    for (std::size_t n = 0; n < position.size(); ++n) {
      velocity[n] = (velocity[n] + dt * (force[n] - pulled[n])) / (1.0 + dt * damping);
      position[n] += dt * velocity[n];
    }
    approach.steps.push_back(step);
    std::vector<double> kept = position;  // what a mass keeps is S^2 of how far it goes
    for (std::size_t n = 0; n < kept.size(); ++n) {
      kept[n] *= network.expandability(n) * network.expandability(n);
    }
    approach.percent.push_back(differencePercent(kept, rest));
    if (approach.percent.back() < NearestPercent) break;
  }
  return approach;
}

}  // namespace

double Approach::stepsTo(double most) const {
  double found = 0.0;
  for (std::size_t n = steps.size(); n-- > 0 && percent[n] <= most;) found = steps[n];
  return found;
}

BentPlane bentPlane() {
  BentPlane bent;
  bent.mesh = plane();
  const double length = EdgeMm * (PlaneSide - 1);
  for (const Vec3& p : bent.mesh.points) {
    bent.force.push_back(std::sin(std::numbers::pi * p.x() / length) *
                         std::sin(std::numbers::pi * p.y() / length));
  }
  const SpringNetwork network(bent.mesh);
  bent.forces = network.forces(bent.force);
  bent.pitching = pitched(network, bent.force, bent.forces, bent.conservation);
  bent.critical = damped(network, bent.force, bent.forces, 1.0);
  bent.light = damped(network, bent.force, bent.forces, Light);
  return bent;
}

BlownDisc blownDisc(double ratio) {
  BlownDisc blown;
  blown.mesh = disc();
  const std::size_t count = blown.mesh.points.size();
  Random random(1);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  random.shuffle(order);
  blown.stiff.assign(count, false);
  for (std::size_t n = 0; n < count / 6; ++n) blown.stiff[order[n]] = true;
  std::vector<double> modulus;
  for (const bool stiff : blown.stiff) modulus.push_back(stiff ? ratio : 1.0);
  const std::vector<double> unit(count, 1.0);
  blown.moved = SpringNetwork(blown.mesh, modulus, {.normalise = false}).forces(unit);
  std::vector<double> stiff;
  std::vector<double> soft;
  for (std::size_t n = 0; n < count; ++n) (blown.stiff[n] ? stiff : soft).push_back(blown.moved[n]);
  blown.stiffPercent = 100.0 * rootMeanSquare(stiff) / rootMeanSquare(soft);
  return blown;
}

double changeByModulusPercent(double factor, bool normalised) {
  const TriangleMesh mesh = plane();
  std::vector<double> force;
  std::vector<double> modulus;
  for (const Vec3& p : mesh.points) {
    force.push_back(1.0 + p.x() / (EdgeMm * PlaneSide));
    modulus.push_back(0.5 + 1.5 * p.y() / (EdgeMm * PlaneSide));
  }
  const auto pattern = [&](double times) {
    std::vector<double> scaled = modulus;
    for (double& value : scaled) value *= times;
    std::vector<double> found =
        SpringNetwork(mesh, scaled, {.normalise = normalised}).forces(force);
    const double size = rootMeanSquare(found);
    for (double& value : found) value /= size;
    return found;
  };
  return differencePercent(pattern(factor), pattern(1.0));
}

RecoveredModuli recoveredModuli() {
  constexpr std::size_t MostSolutions = 200;
  constexpr double Enough = 1e-3;  // relative change of a modulus in a step
  const TriangleMesh mesh = plane();
  const std::size_t count = mesh.points.size();
  const std::vector<double> force(count, 1.0);
  const auto divideByMean = [](std::vector<double>& modulus) {
    double logarithms = 0.0;
    for (const double value : modulus) logarithms += std::log(value);
    const double mean = std::exp(logarithms / static_cast<double>(modulus.size()));
    for (double& value : modulus) value /= mean;
  };
  Random random(1);
  std::vector<double> truth;
  for (std::size_t n = 0; n < count; ++n) truth.push_back(std::exp2(random.uniform(-1.0, 1.0)));
  divideByMean(truth);
  const std::vector<double> moved = SpringNetwork(mesh, truth).forces(force);
  // A mass that moves too far is stiffer than thought; what it keeps goes by 1 / E^2.
  std::vector<double> modulus(count, 1.0);
  RecoveredModuli recovered;
  for (double change = 1.0; change > Enough && recovered.solutions < MostSolutions;) {
    const std::vector<double> found = SpringNetwork(mesh, modulus).forces(force);
    ++recovered.solutions;
    change = 0.0;
    for (std::size_t n = 0; n < count; ++n) {
      const double factor = std::sqrt(found[n] / moved[n]);
      modulus[n] *= factor;
      change = std::max(change, std::abs(factor - 1.0));
    }
    divideByMean(modulus);
  }
  for (std::size_t n = 0; n < count; ++n) {
    recovered.largestErrorPercent =
        std::max(recovered.largestErrorPercent, 100.0 * std::abs(modulus[n] / truth[n] - 1.0));
  }
  return recovered;
}

}  // namespace pneuma
