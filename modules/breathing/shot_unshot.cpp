#include "breathing/shot_unshot.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr double SolvedTo = 1e-12;
constexpr double UsesUp = 1e-12;  // the least share of a force that must stay at a point

/// The shares E of a mesh.
class Shares {
 public:
  Shares(const VertexNeighbours& neighbours, std::span<const double> strain, ForceSharing sharing)
      : neighbours_(neighbours), strain_(strain), sharing_(sharing), sums_(neighbours.size()) {
    if (strain.size() != neighbours.size()) {
      throw InvalidInput("there are " + std::to_string(strain.size()) + " strains for " +
                         std::to_string(neighbours.size()) + " points");
    }
    for (std::size_t n = 0; n < strain.size(); ++n) {
      if (std::isfinite(strain[n]) && strain[n] > 0.0) continue;
      throw InvalidInput("the strain of point " + std::to_string(n) + " is " +
                         std::to_string(strain[n]) + "; it must be above 0");
    }
    for (std::size_t n = 0; n < strain.size(); ++n) {
      sums_[n] = sharing == ForceSharing::Printed ? 0.0 : strain[n];
      for (const std::uint32_t k : neighbours.of(n)) sums_[n] += strain[k];
    }
  }

  std::size_t size() const { return strain_.size(); }

  const VertexNeighbours& neighbours() const { return neighbours_; }

  /// Sum of S over the clique.
  double sum(std::size_t n) const { return sums_[n]; }

  double of(std::size_t from, std::size_t to) const {
    return sharing_ == ForceSharing::Sender ? strain_[to] / sums_[from] : strain_[from] / sums_[to];
  }

  /// True if every point receives less than its neighbours have, or passes on less than it has: the
  /// force then gets less.
  bool useUp() const {
    double least = 1.0;
    for (std::size_t n = 0; n < size(); ++n) {
      double passed = 0.0;
      for (const std::uint32_t k : neighbours_.of(n)) {
        passed += sharing_ == ForceSharing::Sender ? of(n, k) : of(k, n);
      }
      least = std::min(least, 1.0 - passed);
    }
    return least > UsesUp;
  }

 private:
  const VertexNeighbours& neighbours_;
  std::span<const double> strain_;
  ForceSharing sharing_;
  std::vector<double> sums_;
};

/// Points by their values, the largest on top; equal ones in the order of the points.
class LargestFirst {
 public:
  /// @param values outlive this; after each change of one, rose() or fell() must be called
  explicit LargestFirst(const std::vector<double>& values)
      : values_(values), heap_(values.size()), place_(values.size()) {
    std::iota(heap_.begin(), heap_.end(), std::size_t{0});
    std::ranges::sort(heap_, [this](std::size_t a, std::size_t b) { return before(a, b); });
    for (std::size_t n = 0; n < heap_.size(); ++n) place_[heap_[n]] = n;
  }

  std::size_t top() const { return heap_.front(); }

  void rose(std::size_t point) {
    for (std::size_t at = place_[point]; at > 0 && before(point, heap_[(at - 1) / 2]);) {
      exchange(at, (at - 1) / 2);
      at = (at - 1) / 2;
    }
  }

  void fell(std::size_t point) {
    for (std::size_t at = place_[point];;) {
      std::size_t child = 2 * at + 1;
      if (child >= heap_.size()) return;
      if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
      if (!before(heap_[child], point)) return;
      exchange(at, child);
      at = child;
    }
  }

 private:
  bool before(std::size_t a, std::size_t b) const {
    return values_[a] != values_[b] ? values_[a] > values_[b] : a < b;
  }

  void exchange(std::size_t a, std::size_t b) {
    std::swap(heap_[a], heap_[b]);
    place_[heap_[a]] = a;
    place_[heap_[b]] = b;
  }

  const std::vector<double>& values_;
  std::vector<std::size_t> heap_;   // points
  std::vector<std::size_t> place_;  // of each point in the heap
};

std::string neverUsedUp() {
  return "shared as printed, the force is never used up: every point receives as much as its "
         "neighbours pass on, and Shot grows without end; let a point belong to its own clique";
}

void requireForce(std::span<const double> unshot, std::size_t count) {
  if (unshot.size() != count) {
    throw InvalidInput("there are " + std::to_string(unshot.size()) + " forces for " +
                       std::to_string(count) + " points");
  }
  for (std::size_t n = 0; n < count; ++n) {
    if (std::isfinite(unshot[n]) && unshot[n] >= 0.0) continue;
    throw InvalidInput("the force on point " + std::to_string(n) + " is " +
                       std::to_string(unshot[n]) + "; it must not be below 0");
  }
}

double largest(std::span<const double> values) {
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

void finish(SharedForce& result, const Shares& shares, std::size_t relaxations, double left,
            double goal) {
  result.relaxationsPerNode = static_cast<double>(relaxations) /
                              static_cast<double>(std::max<std::size_t>(1, shares.size()));
  result.left = left;
  result.converged = left <= goal;
  if (result.converged) return;
  result.problem = shares.useUp() ? "the force was not used up within " +
                                        std::to_string(std::lround(result.relaxationsPerNode)) +
                                        " relaxations of each point; allow more"
                                  : neverUsedUp();
}

std::size_t most(const SharingLimits& limits, std::size_t count) {
  return static_cast<std::size_t>(limits.relaxationsPerNode * static_cast<double>(count));
}

}  // namespace

SharedForce sharedInTurns(const VertexNeighbours& neighbours, std::span<const double> strain,
                          std::span<const double> unshot, ForceSharing sharing,
                          const SharingLimits& limits) {
  const Shares shares(neighbours, strain, sharing);
  requireForce(unshot, shares.size());
  SharedForce result;
  result.shot.assign(shares.size(), 0.0);
  if (unshot.empty()) return result;
  std::vector<double> waiting(unshot.begin(), unshot.end());
  const double goal = limits.tolerance * largest(unshot);
  LargestFirst order(waiting);
  std::size_t relaxations = 0;
  while (relaxations < most(limits, shares.size())) {
    const std::size_t i = order.top();
    const double force = waiting[i];
    if (force <= goal) break;
    waiting[i] = 0.0;
    order.fell(i);
    for (const std::uint32_t j : neighbours.of(i)) {
      waiting[j] += shares.of(i, j) * force;
      order.rose(j);
    }
    result.shot[i] += force;
    ++relaxations;
  }
  finish(result, shares, relaxations, largest(waiting), goal);
  return result;
}

SharedForce sharedBySweeps(const VertexNeighbours& neighbours, std::span<const double> strain,
                           std::span<const double> unshot, ForceSharing sharing,
                           const SharingLimits& limits) {
  const Shares shares(neighbours, strain, sharing);
  requireForce(unshot, shares.size());
  SharedForce result;
  result.shot.assign(shares.size(), 0.0);
  const double goal = limits.tolerance * largest(unshot);
  std::size_t relaxations = 0;
  double change = largest(unshot);
  while (change > goal && relaxations < most(limits, shares.size())) {
    change = 0.0;
    for (std::size_t j = 0; j < shares.size(); ++j) {
      double received = unshot[j];
      for (const std::uint32_t i : neighbours.of(j)) received += shares.of(i, j) * result.shot[i];
      change = std::max(change, std::abs(received - result.shot[j]));
      result.shot[j] = received;
    }
    relaxations += shares.size();
  }
  finish(result, shares, relaxations, change, goal);
  return result;
}

std::vector<double> sharedForce(const VertexNeighbours& neighbours, std::span<const double> strain,
                                std::span<const double> unshot, ForceSharing sharing) {
  const Shares shares(neighbours, strain, sharing);
  requireForce(unshot, shares.size());
  if (!shares.useUp()) throw Unsupported(neverUsedUp());
  const auto count = static_cast<Eigen::Index>(shares.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right(count);
  const bool receiver = sharing == ForceSharing::Receiver;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    const auto row = static_cast<Eigen::Index>(n);
    const double scale = shares.sum(n) * strain[n];
    entries.emplace_back(row, row, scale);
    for (const std::uint32_t k : neighbours.of(n)) {
      entries.emplace_back(row, static_cast<Eigen::Index>(k), -strain[n] * strain[k]);
    }
    right[row] = receiver ? scale * unshot[n] : unshot[n];
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(SolvedTo);
  solver.compute(matrix);
  const Eigen::VectorXd solved = solver.solve(right);
  std::vector<double> shot(shares.size());
  for (std::size_t n = 0; n < shot.size(); ++n) {
    // The sender's rule is the receiver's the other way round, so that it has the same matrix.
    shot[n] = solved[static_cast<Eigen::Index>(n)] * (receiver ? 1.0 : shares.sum(n) * strain[n]);
  }
  return shot;
}

double sharingRadius(const VertexNeighbours& neighbours, std::span<const double> strain,
                     ForceSharing sharing) {
  const Shares shares(neighbours, strain, sharing);
  constexpr int MostSteps = 2000;
  constexpr double Settled = 1e-10;
  std::vector<double> force(shares.size(), 1.0);
  std::vector<double> next(shares.size());
  double radius = 0.0;
  for (int step = 0; step < MostSteps; ++step) {
    double before = 0.0;
    double after = 0.0;
    for (std::size_t j = 0; j < shares.size(); ++j) {
      next[j] = 0.0;
      for (const std::uint32_t i : neighbours.of(j)) next[j] += shares.of(i, j) * force[i];
      before += force[j] * force[j];
      after += next[j] * next[j];
    }
    const double length = std::sqrt(after);
    for (double& value : next) value /= length > 0.0 ? length : 1.0;
    std::swap(force, next);
    const double found = before > 0.0 ? length / std::sqrt(before) : 0.0;
    if (std::abs(found - radius) < Settled) return found;
    radius = found;
  }
  return radius;
}

}  // namespace pneuma
