#pragma once

#include "anatomy/airway_tree.h"
#include "anatomy/lobe.h"
#include "anatomy/organ_shapes.h"

namespace pneuma {

/// An organ of simple shape with its trunk: one branch from the top straight down to a quarter of
/// the organ's height (Kitaoka 1999, "Initial Conditions"). LPS, mm; the top is the origin.
struct Organ {
  LobeRegion region;
  AirwayTree central;
};

/// The organ of the paper's tables, enlarged or shrunk to a volume; its trunk is 75 mm long and
/// 18 mm wide at the paper's size, and keeps its proportion to the organ.
/// @throws InvalidInput if the volume is not between 1 ml and 100 l; so do the others
Organ simpleOrgan(double volumeMl = SimpleOrgan::VolumeMl);

Organ sphereOrgan(double volumeMl = SimpleOrgan::VolumeMl);

/// Three radii high: 200 mm wide and 300 mm high at the volume of the paper's organ.
Organ cylinderOrgan(double volumeMl = SimpleOrgan::VolumeMl);

Organ cubeOrgan(double volumeMl = SimpleOrgan::VolumeMl);

/// Both lungs without airways, which come from a table (anatomy/predefined_airways.h).
LobeRegion thoraxRegion(double volumeMl);

}  // namespace pneuma
