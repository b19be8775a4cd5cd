#pragma once

#include <string>
#include <vector>

#include "pipeline/fissure_surfaces.h"

namespace pneuma {

/// The share of each fissure of a lung that the points given for it enclose, for those given by
/// points (UsedFissure::coverage).
/// @param lung cut along the surfaces in `used`
/// @param warnings gets a whole sentence for each below a half: points of one part say little of
/// the rest
void addCoverage(UsedFissures& used, const SplitLung& lung, const GivenFissures& given,
                 std::vector<std::string>& warnings);

}  // namespace pneuma
