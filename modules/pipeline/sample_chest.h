#pragma once

#include <string_view>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/progress.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// Where two lobes meet: z = heightMm + slope y + bend y^2 + sideBend (x - sideMm)^2. LPS, mm.
struct SampleFissure {
  std::string_view name;  ///< "right-oblique", "right-horizontal", "left-oblique"
  double heightMm = 0.0;
  double slope = 0.0;
  double bend = 0.0;      ///< 1/mm
  double sideBend = 0.0;  ///< 1/mm
  double sideMm = 0.0;

  double zAt(double x, double y) const {
    return heightMm + slope * y + bend * y * y + sideBend * (x - sideMm) * (x - sideMm);
  }
};

/// A synthetic chest with known truth: both lungs, five lobes as closed surfaces that meet at
/// analytic fissures, and central airways. LPS, mm, carina at the origin.
struct SampleChest {
  std::vector<LobeSurface> lobes;  ///< RUL, RML, RLL, LUL, LLL
  std::vector<LobeRegion> truth;   ///< the same five, as the formulas they were made from
  std::vector<SampleFissure> fissures;
  AirwayTree central;  ///< trachea, main and lobar bronchi (Origin::Template)
};

/// @param cellMm side of the lattice the surfaces are made on, mm
SampleChest sampleChest(double cellMm = 2.0, const Progress& progress = {});

}  // namespace pneuma
