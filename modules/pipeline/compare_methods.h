#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pipeline/compare_trees.h"

namespace pneuma {

/// The trees of several growth methods in the same lobes, from the same central airways.
struct MethodComparison {
  LungModel organ;                                     ///< what they grew in, ready to grow; it has
                                                       ///< no growth
  std::vector<std::shared_ptr<const Growth>> growths;  ///< none null
  TreeComparison measured;                             ///< of their trees, in the same order
};

/// Grows a tree by each of `methods` and measures it, one after the other, so that the seconds of
/// each are those that it takes alone. What it gives is what `pneuma grow` and `pneuma compare`
/// give with the same options; the trees' labels are the methods' names.
/// @throws as grow() and compareTrees(); Cancelled
MethodComparison compareMethods(const LungModel& model, std::span<const GrowthOptions> methods,
                                const Progress& progress = {});

/// `model` with the growth of one of the methods, as grow() leaves it.
/// @param method its place in the comparison
/// @pre `model` has the surfaces and central airways that were grown in
LungModel withGrowthOf(LungModel model, const MethodComparison& comparison, std::size_t method);

}  // namespace pneuma
