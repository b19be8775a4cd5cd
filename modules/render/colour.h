#pragma once

#include <cstdint>

namespace pneuma {

/// A colour as screens take it: sRGB, 0 .. 1.
struct Rgb {
  double r = 0.0;
  double g = 0.0;
  double b = 0.0;

  bool operator==(const Rgb&) const = default;
};

/// CIE 1976 L*a*b*, D65: equal steps look equally different.
struct Lab {
  double l = 0.0;  ///< lightness, 0 .. 100
  double a = 0.0;  ///< green to red
  double b = 0.0;  ///< blue to yellow
};

/// The colour written 0xRRGGBB.
constexpr Rgb rgbOfHex(std::uint32_t hex) {
  return {((hex >> 16) & 0xff) / 255.0, ((hex >> 8) & 0xff) / 255.0, (hex & 0xff) / 255.0};
}

/// `share` of `b` mixed into `a`.
constexpr Rgb mixed(const Rgb& a, const Rgb& b, double share) {
  return {a.r + (b.r - a.r) * share, a.g + (b.g - a.g) * share, a.b + (b.b - a.b) * share};
}

Lab labOf(const Rgb& colour);

/// The nearest colour that a screen has.
Rgb rgbOf(const Lab& colour);

}  // namespace pneuma
