#pragma once

#include <numbers>

/// Conversions at the edge of the program; inside, everything is mm, mm^3, radians and seconds.
namespace pneuma {

constexpr double millilitres(double mm3) { return mm3 / 1000.0; }

constexpr double cubicMillimetres(double ml) { return ml * 1000.0; }

constexpr double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

}  // namespace pneuma
