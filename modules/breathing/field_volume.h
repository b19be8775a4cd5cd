#pragma once

#include <array>
#include <span>
#include <vector>

#include "breathing/volume_polynomial.h"

namespace pneuma {

/// What a closed surface encloses while its points move to x + sum_b w_b u_b(x), for four fields:
/// exactly a cubic in the four weights, kept as 34 numbers beside the volume at rest. So the volume
/// in any posture is known without touching the surface. mm^3
class FieldVolume {
 public:
  /// @param fields of displacements, each with one for every point, mm
  /// @pre the surface is closed and oriented outwards
  FieldVolume(const TriangleMesh& surface, const std::array<std::vector<Vec3>, 4>& fields);

  double at(const std::array<double, 4>& weights) const;

  /// Along the weights: V(s) of s w.
  VolumePolynomial along(const std::array<double, 4>& weights) const;

 private:
  double rest_ = 0.0;
  std::array<double, 4> linear_{};      // w_b
  std::array<double, 10> quadratic_{};  // w_b w_c, b <= c
  std::array<double, 20> cubic_{};      // w_b w_c w_d, b <= c <= d
};

}  // namespace pneuma
