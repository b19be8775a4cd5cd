#pragma once

#include <cmath>

#include "core/math.h"
#include "core/units.h"

namespace pneuma {

/// `value` without its last bits: functions of the mathematical library may differ in them from one
/// machine to the next, and trees must not.
inline double steady(double value) {
  const double lifted = value * 4097.0;
  return lifted - (lifted - value);
}

/// An angle as its cosine and sine. Halving, adding and comparing need only square roots, which
/// every machine rounds alike.
struct Turn {
  double cosine = 1.0;
  double sine = 0.0;

  /// From a cosine; between 0 and 180 degrees.
  static Turn ofCosine(double cosine) {
    const double c = std::clamp(cosine, -1.0, 1.0);
    return {c, std::sqrt(1.0 - c * c)};
  }

  static Turn ofDegrees(double degrees) {
    return {steady(std::cos(radians(degrees))), steady(std::sin(radians(degrees)))};
  }

  double degrees() const { return pneuma::degrees(std::atan2(sine, cosine)); }

  Turn negative() const { return {cosine, -sine}; }

  Turn minus(const Turn& other) const {
    return {cosine * other.cosine + sine * other.sine, sine * other.cosine - cosine * other.sine};
  }

  /// Midway between this and `other`, which is not its opposite.
  Turn bisector(const Turn& other) const {
    const double c = cosine + other.cosine;
    const double s = sine + other.sine;
    const double norm = std::sqrt(c * c + s * s);
    return {c / norm, s / norm};
  }

  /// Part of the way from this to `other`, along the chord between them; they are not opposite.
  Turn towards(const Turn& other, double part) const {
    const double c = cosine + part * (other.cosine - cosine);
    const double s = sine + part * (other.sine - sine);
    const double norm = std::sqrt(c * c + s * s);
    return {c / norm, s / norm};
  }

  /// Half of this turn, which lies between -180 and 180 degrees.
  Turn half() const { return bisector({1.0, 0.0}); }
};

}  // namespace pneuma
