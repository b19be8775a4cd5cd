#pragma once

#include <span>
#include <vector>

#include "breathing/spring_network.h"
#include "core/progress.h"

namespace pneuma {

/// Which node pitches next: that of the largest pitcher, found by a heap, as the paper says; one of
/// the largest power of 2, found by buckets; or all masses and then all springs, round by round.
/// All arrive at the same forces.
enum class PitchOrder { Heap, Buckets, Sweeps };

struct PitchOptions {
  PitchOrder order = PitchOrder::Sweeps;
  double tolerance = 1e-6;  ///< ends when no pitcher is above this share of the mean applied force
};

/// Accumulators of a network, by node.
struct PitchedForces {
  std::vector<double> catcher;  ///< what masses, then springs (SpringNetwork::springNodes), keep
  std::vector<double> pitcher;  ///< what they still hold to pass on
  std::size_t steps = 0;        ///< nodes that pitched

  /// All of both; never changes.
  double sum() const;
};

/// Forces of a spring network as Santhanam 2008 finds them, (12) to (14): a node passes what its
/// pitcher holds on to its neighbours' pitchers and to its own catcher, until nothing is left. In
/// (12) the node itself is left out, as (14) empties it. Slow, and for showing how the method works
/// and that it arrives where SpringNetwork::forces does.
/// @param force by mass
/// @throws InvalidInput if there are not as many forces as masses; Cancelled
PitchedForces pitchForces(const SpringNetwork& network, std::span<const double> force,
                          const PitchOptions& options = {}, const Progress& progress = {});

}  // namespace pneuma
