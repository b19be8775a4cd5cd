#pragma once

#include <array>
#include <string_view>
#include <variant>
#include <vector>

#include "breathing/motion_preset.h"
#include "breathing/published_form.h"

namespace pneuma {

/// Forms whose constants are fitted to a person: the polynomials of the presets, or Santhanam's.
enum class FormKind { Deep, Quiet, Published };

constexpr auto choices(FormKind) {
  return std::array<std::string_view, 3>{"deep", "quiet", "published"};
}

/// A form with the constants of somebody.
using MotionForm = std::variant<PolynomialForm, PublishedForm>;

/// The constants of a polynomial that a kind has. @pre not the published form
TermChoice termsOf(FormKind kind);

/// How many constants a kind has: 9, 10, 9.
std::size_t constantCount(FormKind kind);

/// The constants of a form as a list: of a polynomial those that the kind has, row by row; of the
/// published form c1, c3, c2, c4, c6, the constant of the force, c7, c8, c9 (c5 is 1).
std::vector<double> constantsOf(const MotionForm& form, FormKind kind);

/// @pre as many constants as the kind has
MotionForm formOf(FormKind kind, const std::vector<double>& constants);

/// A form in a lung. Its volume comes out about right only.
class FormField {
 public:
  /// @param strain of the lung: the cube root of its volumes' ratio less 1
  FormField(const MotionForm& form, const LungFrame& frame, double strain);

  explicit FormField(const PresetField& preset) : field_(preset.field()) {}

  /// LPS, mm.
  Vec3 at(const Vec3& p) const;

  /// How the field changes from place to place; a row for each part of the displacement.
  Mat3 gradientAt(const Vec3& p) const;

 private:
  std::variant<PolynomialField, PublishedField> field_;
};

}  // namespace pneuma
