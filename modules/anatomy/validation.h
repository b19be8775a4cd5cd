#pragma once

#include <span>
#include <string>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// What is wrong with a tree, one sentence each; empty if nothing is: no or several roots,
/// a child that does not start where its parent ends, no length, no radius, numbers that are none.
std::vector<std::string> problems(const AirwayTree& tree);

/// Grown branches that leave the lobe they belong to.
struct Outside {
  std::size_t ends = 0;      ///< distal ends outside
  std::size_t segments = 0;  ///< branches with any point outside
};

/// Counts over the grown branches whose lobe is among `lobes`.
Outside outsideTheirLobe(const AirwayTree& tree, std::span<const LobeRegion> lobes);

}  // namespace pneuma
