#pragma once

#include <vector>

#include "core/triangle_mesh.h"

/// The experiments by which Santhanam 2008 (section IV-A, Fig. 7 to 9) holds its method beside
/// masses, springs and dampers.
namespace pneuma {

/// How near a method is to the rest state, by its steps.
struct Approach {
  std::vector<double> steps;
  std::vector<double> percent;  ///< rms difference by the rms of the rest state

  /// The first step from which on it stays within this; 0 if it never does.
  double stepsTo(double most) const;
};

/// The plane of 21 x 21 masses that is bent (Fig. 8) and what becomes of it.
struct BentPlane {
  TriangleMesh mesh;           ///< mm
  std::vector<double> force;   ///< across the plane
  std::vector<double> forces;  ///< what the masses keep: how far they move
  Approach pitching;           ///< rounds over all nodes
  Approach critical;  ///< masses, springs and dampers of the same network, critically damped
  Approach light;     ///< with 0.3 of that damping
  double conservation = 0.0;  ///< what all nodes keep and still hold by what was applied
};

BentPlane bentPlane();

/// The disc of masses, a sixth of them stiff, that is blown up by a unit force on each (Fig. 9).
struct BlownDisc {
  TriangleMesh mesh;          ///< mm
  std::vector<bool> stiff;    ///< by mass
  std::vector<double> moved;  ///< outwards
  double stiffPercent = 0.0;  ///< rms of the stiff masses' displacement by that of the others
};

/// @param ratio Young's modulus of the stiff masses by that of the others
BlownDisc blownDisc(double ratio);

/// By how much the pattern of forces changes if all moduli are multiplied, % rms.
/// @param normalised moduli are divided by their mean before, as in SpringNetwork
double changeByModulusPercent(double factor, bool normalised);

/// Regional expandability found again from how far points move and from the force on them ("the
/// deformation operators can also be used to estimate the alveolar expandability").
struct RecoveredModuli {
  double largestErrorPercent = 0.0;  ///< of a mass's modulus, by the one it had
  std::size_t solutions = 0;         ///< of the network, until it was found
};

/// The plane with random moduli, a half to twice the mean; only their ratios can be told.
RecoveredModuli recoveredModuli();

}  // namespace pneuma
