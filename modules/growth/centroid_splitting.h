#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>

#include "anatomy/diameter_law.h"
#include "core/options.h"
#include "core/progress.h"
#include "growth/containment.h"
#include "growth/growth_result.h"

namespace pneuma {

/// Options of growth by centroid splitting; the defaults are those of Huang 2004.
struct CentroidSplittingOptions {
  double ratio = 0.41;  ///< branch length / distance from the mother's end to the centroid
  int minPoints = 5;    ///< a branch with this many points or fewer is a terminal
  double minLengthMm = 1.2;
  double minAngleDeg = 20.0;
  double maxAngleDeg = 60.0;
  double spacingMm = 3.2298;
  std::uint64_t points = 0;
  std::uint64_t terminals = 0;
  double jitter = 0.0;
  std::uint64_t seed = 1;
  Containment containment = Containment::Branches;
  DiameterLaw diameterLaw = DiameterLaw::Weibel;
  double diameterExponent = 2.8;

  static constexpr auto fields() {
    using O = CentroidSplittingOptions;
    return std::tuple{
        Field{"ratio", &O::ratio, "", Range{0.05, 1.0},
              "Branch length as a share of the way to the centroid of the points it serves."},
        Field{"min-points", &O::minPoints, "", Range{1, 1000},
              "A branch that serves this many points or fewer is a terminal."},
        Field{"min-length", &O::minLengthMm, "mm", Range{0.0, 50.0},
              "Shorter branches are not made. Scaled with the spacing of the points: this value "
              "holds at the paper's 3.2298 mm."},
        Field{"min-angle", &O::minAngleDeg, "deg", Range{0.0, 90.0}, "Smallest branching angle."},
        Field{"max-angle", &O::maxAngleDeg, "deg", Range{0.0, 180.0}, "Largest branching angle."},
        Field{"spacing", &O::spacingMm, "mm", Range{0.05, 100.0},
              "Distance of the points that fill the lobes (the paper: 103,894 points in 3.5 l)."},
        Field{"points", &O::points, "", Range{0, 20e6},
              "Fill the lobes with exactly this many points; 0: as the spacing says."},
        Field{"terminals", &O::terminals, "", Range{0, 5e6},
              "Choose the spacing for about this many terminals; 0: as points or spacing say."},
        Field{"jitter", &O::jitter, "", Range{0.0, 1.0},
              "Random shift of every point, in spacings: 0 is a lattice."},
        Field{"seed", &O::seed, "", Range{0, 9007199254740991.0},
              "Seed of everything random: same seed, same tree."},
        Field{"containment", &O::containment, "", Range{},
              "What must stay inside its lobe: none (as the paper), ends, branches."},
        Field{"diameter-law", &O::diameterLaw, "", Range{},
              "Diameters by Weibel's table (weibel) or by flow (flow)."},
        Field{"diameter-exponent", &O::diameterExponent, "", Range{1.5, 4.0},
              "Exponent n of flow = D^n for diameter-law flow."},
    };
  }

  bool operator==(const CentroidSplittingOptions&) const = default;
};

/// Fills the lobes by recursive splitting of the points in them (Huang 2004; every step, and where
/// we differ, in docs/algorithms/centroid-splitting.md).
/// @throws InvalidInput, InvalidOption, Cancelled (see growAirways)
GrowthResult growByCentroidSplitting(const AirwayTree& central, std::span<const LobeRegion> lobes,
                                     const CentroidSplittingOptions& options,
                                     const Progress& progress = {});

}  // namespace pneuma
