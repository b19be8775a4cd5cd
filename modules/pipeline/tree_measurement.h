#pragma once

#include <map>
#include <optional>

#include "anatomy/morphometry.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// Everything that is measured of one tree.
struct TreeMeasurement {
  std::size_t problems = 0;  ///< see problems(tree)
  Morphometry whole;
  std::map<Lobe, Morphometry> byLobe;
  std::optional<Outside> outside;        ///< where regions are known
  std::optional<Efficiency> efficiency;  ///< likewise
};

/// Measures a tree in the regions of `organ`, if it has any. @param seed of the random points of
/// the gap. @throws InvalidInput for an empty tree; Cancelled
TreeMeasurement measureTree(const AirwayTree& tree, const LungModel& organ, std::uint64_t seed = 1,
                            const Progress& progress = {});

/// The members of a report that tell of one tree: outside, branches, terminals, morphometry,
/// efficiency and lobes. What was not measured is left out.
Json toJson(const TreeMeasurement& measured);

/// What must hold of a tree, each with "id", "value", "limit" and "ok".
Json checksOf(const TreeMeasurement& measured);

}  // namespace pneuma
