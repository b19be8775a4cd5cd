#pragma once

#include <filesystem>

#include "breathing/breath_fit.h"

namespace pneuma {

/// Reads a measured breath from a CSV file with the columns `seconds` (or `time_s`),
/// `pressure_cmH2O` and `volume_ml` (or `volume_l`), such as the table of `pneuma breathe --curve`.
/// @throws InputMissing; InvalidInput naming the line (see readNumberTable). Whether it is a breath
/// is for fitBreath() to say.
MeasuredBreath readMeasuredBreath(const std::filesystem::path& path);

}  // namespace pneuma
