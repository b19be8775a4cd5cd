#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/progress.h"
#include "growth/centroid_splitting.h"
#include "growth/dla.h"
#include "growth/kitaoka.h"

namespace pneuma {

/// The choice of a method is the choice of its options. A new method is one more alternative here
/// and one more row in growthMethods().
using GrowthOptions = std::variant<KitaokaOptions, CentroidSplittingOptions, DlaOptions>;

/// One row of the menus, of `pneuma grow --method` and of the tests.
struct GrowthMethod {
  std::string_view name;      ///< as typed: "centroid"
  std::string_view title;     ///< for people
  std::string_view citation;  ///< the paper
  GrowthOptions defaults;
};

std::span<const GrowthMethod> growthMethods();

/// @throws InvalidOption if there is no such method (the nearest is suggested)
const GrowthMethod& growthMethod(std::string_view name);

/// The row of the method that these options belong to.
const GrowthMethod& growthMethod(const GrowthOptions& options);

/// Grows airways from the terminals of `central` until they fill `lobes`.
///
/// The branches of `central` come first in the result, untouched but for their lobe.
/// The result is the same for any number of threads.
/// @throws InvalidInput if a lobe has no inlet or no room; InvalidOption naming a field out of
/// range;
///         Cancelled
GrowthResult growAirways(const AirwayTree& central, std::span<const LobeRegion> lobes,
                         const GrowthOptions& options, const Progress& progress = {});

}  // namespace pneuma
