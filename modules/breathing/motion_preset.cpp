#include "breathing/motion_preset.h"

#include <cmath>

namespace pneuma {
namespace {

constexpr double QuietInnerShare = 0.75;

const PolynomialForm& constantsOfPreset(MotionPreset preset) {
  static const PolynomialForm deep{PolynomialForm::Constants{{0.52, -0.34, -0.08, 0.0, 0.0, 0.0},
                                                             {0.46, 0.64, 0.50, 0.0, 0.0, 0.0},
                                                             {0.07, -0.29, 0.82, 0.0, 0.0, 0.0}}};
  static const PolynomialForm quiet{
      PolynomialForm::Constants{{0.48, 0.0, 0.0, -0.25, 0.0, 0.0},
                                {-0.66, 0.12, 0.44, 0.0, 0.0, 0.0},
                                {0.42, -0.69, 2.94, 0.0, -1.56, -0.27}}};
  return preset == MotionPreset::Deep ? deep : quiet;
}

double strainOf(MotionPreset preset, double gain) {
  return (std::cbrt(1.0 + gain) - 1.0) * (preset == MotionPreset::Quiet ? QuietInnerShare : 1.0);
}

}  // namespace

PresetField::PresetField(MotionPreset preset, const LungFrame& frame, double gain)
    : field_(constantsOfPreset(preset), frame, strainOf(preset, gain)) {}

TermChoice termsOf(MotionPreset preset) {
  return constantsOfPreset(preset).constants.array() != 0.0;
}

}  // namespace pneuma
