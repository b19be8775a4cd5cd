#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "anatomy/lobe.h"

namespace pneuma {

/// What parts the lobes of a lung. The oblique fissure is also called the major one, the horizontal
/// fissure the minor one.
enum class Fissure : std::uint8_t { RightOblique, RightHorizontal, LeftOblique };

inline constexpr std::array<Fissure, 3> ThreeFissures = {
    Fissure::RightOblique, Fissure::RightHorizontal, Fissure::LeftOblique};

/// "right-oblique", "right-horizontal", "left-oblique": as in files and options.
std::string_view shortName(Fissure fissure);

/// "right oblique fissure", ...
std::string_view longName(Fissure fissure);

std::optional<Fissure> fissureOfShortName(std::string_view text);

Side side(Fissure fissure);

}  // namespace pneuma
