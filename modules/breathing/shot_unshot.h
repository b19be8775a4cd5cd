#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "breathing/vertex_neighbours.h"

namespace pneuma {

/// Which share E of its force a point i of strain S_i passes on to its neighbour j.
enum class ForceSharing {
  /// S_i / sum of S over j and its neighbours: the paper's formula with a point in its own clique.
  Receiver,
  /// S_j / sum of S over i and its neighbours: the rule of Santhanam 2008. Sums up to less than the
  /// force, but prints the number of neighbours into the result.
  Sender,
  /// S_i / sum of S over j's neighbours alone, as printed. What a point receives is never less than
  /// what its neighbours had: the force does not get used up.
  Printed,
};

/// What Santhanam 2003 calls Shot: how far each point goes.
struct SharedForce {
  std::vector<double> shot;
  double relaxationsPerNode = 0.0;  ///< points worked off, by the number of points
  double left = 0.0;                ///< the largest force that is still unshot
  bool converged = false;
  std::string problem;  ///< why not, a whole sentence; empty if it did
};

/// When to stop.
struct SharingLimits {
  double tolerance = 1e-6;           ///< of the largest unshot force, by the largest at first
  double relaxationsPerNode = 1000;  ///< at most
};

/// The paper's Fig. 2 to the letter: the point with the largest unshot force passes it on, again
/// and again (Southwell's relaxation). The printed sharing ends at the limit, with the reason.
/// @param strain S of every point, above 0
/// @param unshot the force that every point begins with, 0 or above
/// @throws InvalidInput if a strain is not above 0 or the counts differ
SharedForce sharedInTurns(const VertexNeighbours& neighbours, std::span<const double> strain,
                          std::span<const double> unshot, ForceSharing sharing,
                          const SharingLimits& limits = {});

/// The same Shot by sweeps over the points in their order (Gauss-Seidel).
SharedForce sharedBySweeps(const VertexNeighbours& neighbours, std::span<const double> strain,
                           std::span<const double> unshot, ForceSharing sharing,
                           const SharingLimits& limits = {});

/// The same Shot by solving its equation, which is symmetric and positive definite after scaling:
/// (diag(W S) - S A S) z = right side, A the neighbourhood, W_j the sum over j's clique.
/// @throws Unsupported for the printed sharing, whose equation has no solution; InvalidInput as
/// above
std::vector<double> sharedForce(const VertexNeighbours& neighbours, std::span<const double> strain,
                                std::span<const double> unshot, ForceSharing sharing);

/// By how much a sweep without order (Jacobi) shrinks the unshot force in the long run; 1: never.
double sharingRadius(const VertexNeighbours& neighbours, std::span<const double> strain,
                     ForceSharing sharing);

}  // namespace pneuma
