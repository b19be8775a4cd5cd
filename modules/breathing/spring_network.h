#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "breathing/point_matrix.h"

namespace pneuma {

/// What the paper leaves open about its springs.
struct SpringNetworkOptions {
  /// Young's moduli are divided by their geometric mean. The paper holds its result to be
  /// independent of their absolute size, but a spring carries E where a mass carries 1 / E: without
  /// this four times the moduli change the pattern by more than a quarter.
  bool normalise = true;
  /// A point's springs weigh 6 / (number of its edges), so that points of few edges do not stand
  /// out.
  bool evenValence = false;
};

/// The surface of a lung as masses and springs (Santhanam 2008, III-E to III-G, equation (8)):
/// every point a mass, every edge a spring node at its middle. A force on the masses is passed on
/// by
///   T_e[j -> i] = S_i / d_ij / (S_j + sum over neighbours l of S_l / d_lj),
/// S = 1 / E of masses and E of springs (the mean of both ends), d >= 1 the distance in mm, the
/// node itself among its neighbours: without it nothing is ever absorbed. What pitching and
/// catching arrives at (see pitchForces) is F = S^2 z of the symmetric positive definite system
/// (diag(S^2) + L) z = f with conductances S_i S_j / d_ij, in which spring nodes can be eliminated
/// exactly: a system of one unknown for each point, well conditioned on any mesh.
/// The force reaches less than an edge; on fine meshes F is a factor of f, point by point.
class SpringNetwork {
 public:
  /// @param surface mm
  /// @param modulus Young's modulus of every point, any unit, above 0; empty: the same everywhere
  /// @throws InvalidInput if there are no points, another number of moduli, or a modulus is not
  /// above 0
  explicit SpringNetwork(const TriangleMesh& surface, std::span<const double> modulus = {},
                         const SpringNetworkOptions& options = {});

  struct Spring {
    std::array<std::uint32_t, 2> mass;  ///< points at its ends, the smaller first
    std::array<double, 2> distance;     ///< d to each, mm, at least 1; by valence if even
  };

  std::size_t masses() const { return stiffness_.size(); }

  std::size_t springs() const { return matrix_.column.size() / 2; }

  /// Every edge once, in the order of springForces. Made anew at every call.
  std::vector<Spring> springNodes() const;

  /// S of a mass.
  double expandability(std::size_t mass) const { return 1.0 / stiffness_[mass]; }

  /// S of a spring.
  double expandability(const Spring& spring) const {
    return 0.5 * (stiffness_[spring.mass[0]] + stiffness_[spring.mass[1]]);
  }

  /// What each mass keeps of forces on the masses: F.
  /// @param force by point, any unit
  /// @throws InvalidInput if there are not as many as points; Cancelled
  std::vector<double> forces(std::span<const double> force, const SolveOptions& options = {},
                             const Progress& progress = {}) const;

  /// What each spring keeps where masses keep `forces`: both together are as much as was applied.
  /// For display the paper gives a spring the mean of its ends instead.
  std::vector<double> springForces(std::span<const double> forces) const;

  /// The force on the masses that makes them keep `forces`: the inverse of forces(), without a
  /// solution.
  std::vector<double> appliedFor(std::span<const double> forces) const;

  /// The system of the masses alone.
  const PointMatrix& matrix() const { return matrix_; }

 private:
  Spring springBetween(std::uint32_t a, std::uint32_t b) const;
  double valenceShare(std::uint32_t mass) const;

  std::vector<Vec3> points_;
  std::vector<double> stiffness_;  // E
  bool evenValence_;
  PointMatrix matrix_;
};

}  // namespace pneuma
