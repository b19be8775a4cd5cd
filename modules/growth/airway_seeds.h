#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/domain.h"

namespace pneuma {

/// A point of a central airway from which an aggregate may grow.
struct AirwaySeed {
  Vec3 point;       ///< on the centreline, inside the lobe
  int parent = -1;  ///< the branch at whose distal end a branch from here starts
  /// From that end along the airway to `point`, both left out: an airway's side branches start at
  /// its nearer end.
  std::vector<Vec3> way;
};

/// The centrelines of the airways that end in a lobe, from their ends backwards as long as they
/// stay in the lobe, in points at most `stepMm` apart. The ends themselves come first.
/// @param inlets branches of `central` that end inside the domain
std::vector<AirwaySeed> airwaySeeds(const AirwayTree& central, std::span<const std::size_t> inlets,
                                    const Domain& domain, double stepMm);

}  // namespace pneuma
