#pragma once

#include "growth/outline_aggregation.h"
#include "render/picture.h"

namespace pneuma::cli {

/// An aggregate in the outline of a lung like Fig. 1 of Zhang 2003: two picture pixels for each of
/// the standard size (0.6 mm), particles black, the first airways red, the outline grey, key points
/// blue, orange and green from above. Needs no display.
Picture outlinePicture(const OutlineAggregate& aggregate);

}  // namespace pneuma::cli
