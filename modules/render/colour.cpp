#include "render/colour.h"

#include <algorithm>
#include <cmath>

namespace pneuma {
namespace {

// White point D65 and the sRGB primaries of IEC 61966-2-1.
constexpr double WhiteX = 0.95047;
constexpr double WhiteZ = 1.08883;
constexpr double Knee = 6.0 / 29.0;

double linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

double gammaCoded(double l) {
  l = std::clamp(l, 0.0, 1.0);
  return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
}

double compressed(double t) {
  return t > Knee * Knee * Knee ? std::cbrt(t) : t / (3.0 * Knee * Knee) + 4.0 / 29.0;
}

double expanded(double f) { return f > Knee ? f * f * f : 3.0 * Knee * Knee * (f - 4.0 / 29.0); }

}  // namespace

Lab labOf(const Rgb& colour) {
  const double r = linear(colour.r);
  const double g = linear(colour.g);
  const double b = linear(colour.b);
  const double x = compressed((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / WhiteX);
  const double y = compressed(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
  const double z = compressed((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / WhiteZ);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Rgb rgbOf(const Lab& colour) {
  const double fy = (colour.l + 16.0) / 116.0;
  const double x = WhiteX * expanded(fy + colour.a / 500.0);
  const double y = expanded(fy);
  const double z = WhiteZ * expanded(fy - colour.b / 200.0);
  return {gammaCoded(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
          gammaCoded(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
          gammaCoded(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

}  // namespace pneuma
