#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "breathing/lung_frame.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// What the points of a lung's surface keep of the force law in every posture at once. The law is a
/// sum of 1, q_X, q_Y and q_Z (forceCoefficients), and both operators, SpringNetwork and
/// ElasticSurface, are linear: four solutions and four numbers for a direction of gravity are the
/// solution for it, exactly.
class OrientedForces {
 public:
  using Operator = std::function<std::vector<double>(std::span<const double>)>;

  /// @param solved what the surface's points keep of forces on them
  OrientedForces(const TriangleMesh& surface, const LungFrame& frame, const Operator& solved);

  /// Of every point for coefficients of 1, q_X, q_Y and q_Z.
  std::vector<double> at(const std::array<double, 4>& coefficients) const;

  /// The solutions for 1, q_X, q_Y and q_Z.
  const std::array<std::vector<double>, 4>& solutions() const { return solutions_; }

 private:
  std::array<std::vector<double>, 4> solutions_;
};

}  // namespace pneuma
