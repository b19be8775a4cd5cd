#include "breathing/oriented_forces.h"

#include "breathing/posture.h"

namespace pneuma {

OrientedForces::OrientedForces(const TriangleMesh& surface, const LungFrame& frame,
                               const Operator& solved) {
  std::vector<double> force(surface.points.size());
  for (std::size_t k = 0; k < solutions_.size(); ++k) {
    std::array<double, 4> one{};
    one[k] = 1.0;
    for (std::size_t n = 0; n < force.size(); ++n) {
      force[n] = forceAt(one, frame.shareOf(surface.points[n]));
    }
    solutions_[k] = solved(force);
  }
}

std::vector<double> OrientedForces::at(const std::array<double, 4>& b) const {
  std::vector<double> forces(solutions_[0].size());
  for (std::size_t n = 0; n < forces.size(); ++n) {
    forces[n] = b[0] * solutions_[0][n] + b[1] * solutions_[1][n] + b[2] * solutions_[2][n] +
                b[3] * solutions_[3][n];
  }
  return forces;
}

}  // namespace pneuma
