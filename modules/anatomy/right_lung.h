#pragma once

#include <vector>

#include "anatomy/airway_tree.h"
#include "anatomy/lobe.h"

namespace pneuma {

/// The synthetic right lung in which Huang 2004 is reproduced: a superellipse section with
/// diaphragm, heart and spine taken out, three lobes by an oblique and a horizontal fissure.
/// LPS, mm; the carina is the origin, the lung lies at negative x.
struct RightLung {
  std::vector<LobeRegion> lobes;  ///< RUL, RML, RLL
  AirwayTree central;             ///< trachea, right main, RUL, intermediate, RML, RLL (template)
};

/// @param volumeMl volume of the lung; the paper's point set fits 3500 ml
/// @param upperFraction, middleFraction shares of the upper and middle lobe (Huang: 0.36, 0.18)
/// @throws InvalidInput if a value is not possible
RightLung rightLung(double volumeMl = 3500.0, double upperFraction = 0.36,
                    double middleFraction = 0.18);

}  // namespace pneuma
