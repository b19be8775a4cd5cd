#pragma once

#include "breathing/published_form.h"

namespace pneuma {

/// Numbers of any sign and size that stand for the directions of a published form while they are
/// looked for: ln c1, ln c3 in -4 to 4, c2, c4, c6 in 0.05 to 5 (c5 is 1). A bound itself is not
/// reached.
using DirectionUnknowns = Eigen::Vector<double, 5>;

DirectionUnknowns directionUnknowns(const PublishedForm& form);

/// With a force of 0.
PublishedForm directionsOf(const DirectionUnknowns& unknowns);

}  // namespace pneuma
