#pragma once

#include <string>

#include "anatomy/efficiency.h"
#include "io/json.h"

namespace pneuma {

/// The "efficiency" object of the growth and measure reports: counts, and the functions N, Q_f,
/// C_n, C_a, V_r, EL and PI in the paper's and in today's definitions, with the cubes and the
/// volume that they were taken of. What is not known is null.
Json toJson(const Efficiency& efficiency);

/// Three lines for people.
std::string efficiencyText(const Efficiency& efficiency);

}  // namespace pneuma
