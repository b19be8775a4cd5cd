#pragma once

#include <array>
#include <map>
#include <vector>

#include "breathing/breath_fit.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"

/// Experiments of Santhanam 2008 that its tables and figures share.
namespace pneuma {

/// A scenario's breath as if it had been measured: 201 rows.
/// @param noise normally distributed, share of the tidal volume; the same numbers every time
MeasuredBreath measuredScenario(Breathing breathing, double noise = 0.0);

/// The sample's lungs while they take in up to three litres, the deep breath's field: what Fig. 4
/// shows of a person.
struct InhaledVolumes {
  std::vector<double> litres;                ///< above the end of expiration
  std::vector<double> scale;                 ///< of the right lung's displacements
  std::array<std::vector<double>, 3> boxMm;  ///< lengths of the box around both: LPS
  std::vector<double> boxShare;              ///< volume of both by that of their box
};

InhaledVolumes inhaledVolumes(const Progress& progress = {});

/// Share of the variance of `y` that a line through the first `count` points explains: R^2.
double linearity(const std::vector<double>& x, const std::vector<double>& y, std::size_t count);

/// A tumour in the lower part of the right lung and a needle that lies through it at the end of
/// expiration, from the side, held still while the lungs breathe.
struct NeedledTumour {
  double radiusMm = 0.0;
  double farthestMm = 0.0;  ///< of its centre from the needle
  double hitShare = 0.0;    ///< of the breath's time in which the needle is in it
};

/// The sample's right lung in quiet breathing.
NeedledTumour needledTumour();

}  // namespace pneuma
