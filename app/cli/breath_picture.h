#pragma once

#include "breathing/breath_fit.h"
#include "render/picture.h"

namespace pneuma::cli {

/// A breath's loop of pressure and volume, and its volume over time, side by side.
/// @param measured drawn as dots; without rows: not there
Picture breathPicture(const BreathCycle& cycle, const MeasuredBreath& measured = {});

}  // namespace pneuma::cli
