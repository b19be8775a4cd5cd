#pragma once

#include <span>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// A bronchus from which a lobe is grown.
struct Inlet {
  std::size_t branch = 0;  ///< a terminal of the central tree
  std::size_t region = 0;  ///< index of the lobe it ends in
};

/// Finds the lobe of every terminal of `central` and marks every branch with the lobe that all
/// terminals below it share, or Lobe::Central.
///
/// Terminals that end in no lobe are left out: they stay as they are and nothing grows from them.
/// @throws InvalidInput if a lobe has no terminal inside it (naming the lobe and what to do)
std::vector<Inlet> assignLobes(AirwayTree& central, std::span<const LobeRegion> lobes);

/// Trachea, main and lobar bronchi for lungs that come without measured airways. The main bronchi
/// part between the lungs at the height of the hilum; each lobar bronchus is aimed at its lobe's
/// centre and ends inside it. A single region gets one trunk from above that ends inside it.
/// Lengths and diameters are those of Huang 2004 and of Weibel's table.
/// @throws InvalidInput if there is no region, or one is too thin to hold a bronchus
AirwayTree templateAirways(std::span<const LobeRegion> lobes);

}  // namespace pneuma
