#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "anatomy/airway_tree.h"
#include "anatomy/lobe.h"
#include "growth/airway_seeds.h"

namespace pneuma {

/// The cluster that has grown in one lobe.
struct LobeAggregate {
  LobeRegion region;
  double voxelMm = 1.0;
  std::vector<AirwaySeed> seeds;
  std::vector<Vec3> positions;        ///< of the particles in order of arrival, LPS, mm
  std::vector<std::int32_t> parents;  ///< a particle that came before, or ~s for seed s
};

/// How an aggregate becomes branches.
struct AggregateTreeRules {
  int minTwig = 4;    ///< side twigs with fewer particles from their foot to their farthest tip go
  int smoothing = 2;  ///< passes over the lattice's staircase
};

/// Particles without a daughter, and how many of those are left after twigs have gone.
struct AggregateTips {
  std::size_t all = 0;
  std::size_t kept = 0;
};

/// Adds an aggregate to the tree it grew from. Short twigs are left out (at every particle the way
/// to the farthest tip stays, and those of at least `minTwig` particles), chains become branches
/// with their way in `via`, positions are smoothed as far as everything stays in the lobe. Every
/// tip supplies the same share of the lobe. Radii are left to anatomy/diameter_law.h.
/// @pre straight ways between a particle and its parent lie in the lobe
AggregateTips appendAggregate(AirwayTree& tree, const LobeAggregate& aggregate,
                              const AggregateTreeRules& rules);

}  // namespace pneuma
