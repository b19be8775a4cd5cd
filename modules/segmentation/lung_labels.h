#pragma once

#include <cstdint>

#include "anatomy/lobe.h"

namespace pneuma {

/// What stands in the label image of a CT before the lungs are divided.
inline constexpr auto RightLabel = static_cast<std::uint8_t>(Lobe::RightLung);
inline constexpr auto LeftLabel = static_cast<std::uint8_t>(Lobe::LeftLung);
inline constexpr auto AirwayLabel = static_cast<std::uint8_t>(Lobe::Central);

}  // namespace pneuma
