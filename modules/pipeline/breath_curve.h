#pragma once

#include <string>

#include "breathing/breath_fit.h"

namespace pneuma {

/// The curve of pressure and volume of a breath as CSV: seconds, pressure_cmH2O, flow_ml_per_s,
/// volume_ml (above that at rest), 501 rows, the last one period after the first.
/// readMeasuredBreath() takes it.
std::string breathCurveCsv(const BreathCycle& cycle);

}  // namespace pneuma
