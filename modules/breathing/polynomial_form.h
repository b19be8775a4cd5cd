#pragma once

#include <array>
#include <string_view>

#include "breathing/lung_frame.h"
#include "core/image.h"

namespace pneuma {

/// Displacement as a polynomial of the shares q of the lung's box,
///   u_k = strain L_k sum_j constants(k, j) phi_j(q),   L the box's lengths.
struct PolynomialForm {
  static constexpr int Terms = 6;  ///< phi: q_X, q_Y, q_Z, q_X q_Z, q_Y q_Z, q_Z^2
  static constexpr std::array<std::string_view, Terms> TermNames = {"qX",   "qY",   "qZ",
                                                                    "qXqZ", "qYqZ", "qZqZ"};
  using Constants = Eigen::Matrix<double, 3, Terms>;

  Constants constants = Constants::Zero();  ///< a row for X, Y and Z

  bool operator==(const PolynomialForm&) const = default;

  /// phi.
  static Eigen::Vector<double, Terms> terms(const Vec3& share);
};

/// 0.7 of the same expansion in all directions, seen from heart, back and apex.
PolynomialForm evenForm();

/// A polynomial form in a lung. Its volume comes out about right only.
class PolynomialField {
 public:
  /// @param strain of the lung: the cube root of its volumes' ratio less 1
  PolynomialField(const PolynomialForm& form, const LungFrame& frame, double strain)
      : form_(form), frame_(frame), strain_(strain) {}

  /// LPS, mm.
  Vec3 at(const Vec3& p) const;

  /// How the field changes from place to place; a row for each part of the displacement.
  Mat3 gradientAt(const Vec3& p) const;

 private:
  PolynomialForm form_;
  LungFrame frame_;
  double strain_;
};

}  // namespace pneuma
