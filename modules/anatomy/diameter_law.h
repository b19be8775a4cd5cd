#pragma once

#include <array>
#include <string_view>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// How wide grown branches are.
enum class DiameterLaw { Weibel, Flow };

constexpr std::array<std::string_view, 2> choices(DiameterLaw) { return {"weibel", "flow"}; }

/// Weibel's regular model A (1963): airway diameter by generation, mm; the trachea is generation 0.
/// Clamped to generations 0 .. 23.
double weibelDiameterMm(int generation);

/// Sets the radius of every grown branch; measured and template branches keep theirs.
///
/// Weibel: the table by generation, scaled so that it meets the last branch that is not grown.
/// Flow: D = D_inlet * (flow / flow_inlet)^(1 / exponent) below that branch (Murray: exponent 3,
/// Kitaoka 1999: 2.8). No branch becomes wider than its parent.
/// @param exponent used by Flow only
void assignDiameters(AirwayTree& tree, DiameterLaw law, double exponent);

}  // namespace pneuma
