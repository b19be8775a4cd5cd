#pragma once

#include <optional>
#include <string>

#include "core/image.h"

namespace pneuma {

/// Labels whose lungs are hardly anywhere filled with air in a CT are those of another one.
inline constexpr int AirInLungsHu = -300;     ///< lighter than this holds air
inline constexpr double LeastAirShare = 0.5;  ///< of the labelled lungs

/// How much of what is labelled as lung or lobe is lighter than AirInLungsHu where it lies in the
/// CT, 0 .. 1. What lies outside the CT counts as not.
/// @return none if nothing is labelled so
std::optional<double> shareOfAir(const CtImage& ct, const LabelImage& labels);

/// A sentence for the user if labels hardly fit a CT; none if they do. It is no error: lungs may be
/// as dense as that in a severe disease.
std::optional<std::string> misfitOf(const CtImage& ct, const LabelImage& labels);

}  // namespace pneuma
