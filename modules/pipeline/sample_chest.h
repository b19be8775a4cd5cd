#pragma once

#include <vector>

#include "anatomy/airway_tree.h"
#include "core/progress.h"
#include "pipeline/lung_model.h"
#include "pipeline/sample_fissure.h"

namespace pneuma {

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
