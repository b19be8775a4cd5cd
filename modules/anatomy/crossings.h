#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/progress.h"

namespace pneuma {

/// Pairs of branches (lower index first, sorted) that are not kin but whose tubes overlap, tubes
/// being cylinders with rounded ends around the centre lines.
///
/// Branches joined by one-daughter steps are one and go by the index of their first. Kin are those
/// with at most one branch between them: mother and daughter, sisters, grandmother, aunt and niece.
/// Their tubes have to overlap near the fork they share.
std::vector<std::pair<std::size_t, std::size_t>> crossings(const AirwayTree& tree,
                                                           const Progress& progress = {});

}  // namespace pneuma
