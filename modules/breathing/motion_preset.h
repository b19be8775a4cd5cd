#pragma once

#include <array>
#include <string_view>

#include "breathing/polynomial_form.h"

namespace pneuma {

/// Two ways of moving that were fitted to landmarks of people: breathing in deeply, and quietly
/// lying on the back. One is no good for the other.
enum class MotionPreset { Quiet, Deep };

constexpr auto choices(MotionPreset) { return std::array<std::string_view, 2>{"quiet", "deep"}; }

/// Where every point of a lung at the end of expiration moves while its volume becomes 1 + `gain`
/// times as large: u_k = strain L_k sum_j a_kj phi_j(q), q the shares of the lung's box and L its
/// lengths, with nine (deep) or ten (quiet) constants. The strain is the cube root of the volumes'
/// ratio less 1; quiet breathing takes 0.75 of it, which is what the inside of a lung expands by.
/// Deep: three people with COPD, full inspiration; quiet: ten 4D CTs. Expect errors of 3 to 4 mm in
/// quiet breathing and 7 to 10 mm in a deep breath. Volumes come out about right only: see
/// VolumeLayer.
class PresetField {
 public:
  /// @param gain of volume, above -1
  PresetField(MotionPreset preset, const LungFrame& frame, double gain);

  /// LPS, mm.
  Vec3 at(const Vec3& p) const { return field_.at(p); }

  /// How the field changes from place to place; a row for each part of the displacement.
  Mat3 gradientAt(const Vec3& p) const { return field_.gradientAt(p); }

  const PolynomialField& field() const { return field_; }

 private:
  PolynomialField field_;
};

/// Which constants of a polynomial are used; the others are 0.
using TermChoice = Eigen::Array<bool, 3, PolynomialForm::Terms>;

/// The nine (deep) or ten (quiet) of a preset.
TermChoice termsOf(MotionPreset preset);

}  // namespace pneuma
