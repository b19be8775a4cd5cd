#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// One daughter of a predefined bifurcation.
struct PredefinedDaughter {
  std::string name;       ///< "RUL", "RB3" ...
  double angleDeg = 0.0;  ///< to the parent's direction
  double lengthToDiameter = 3.0;
};

/// A bifurcation whose geometry is given; flows and diameters follow from the regions it divides.
struct PredefinedBifurcation {
  std::string parent;
  PredefinedDaughter a;       ///< leaves towards `hint`
  PredefinedDaughter b;       ///< leaves away from it, in the same plane
  Vec3 hint = Vec3::UnitX();  ///< its part normal to the parent, turned by `azimuthDeg` about the
                              ///< parent's direction (right-handed), is the side of daughter a; LPS
  double azimuthDeg = 0.0;
};

/// The central airways of an organ, given by their branching angles, length-to-diameter ratios and
/// branching planes (Kitaoka 1999, "Initial Conditions": the thorax).
struct PredefinedAirways {
  std::string root = "TRACHEA";
  Vec3 start = Vec3::Zero();                        ///< proximal end of the root, LPS, mm
  Vec3 direction = -Vec3::UnitZ();                  ///< of the root, unit vector, LPS
  double diameterMm = 18.0;                         ///< of the root
  double lengthMm = 105.0;                          ///< of the root
  std::vector<PredefinedBifurcation> bifurcations;  ///< parents before their daughters
};

}  // namespace pneuma
