#pragma once

#include <map>
#include <span>
#include <string>

#include "growth/growth_result.h"

namespace pneuma {

/// A VTP file with one vertex for every particle of an aggregate and the point arrays `arrival` (0
/// for the first) and `lobe`; LPS, mm.
/// @param metadata field data, as in tree files
std::string aggregateText(std::span<const AggregatePoint> aggregate,
                          const std::map<std::string, std::string>& metadata = {});

}  // namespace pneuma
