#pragma once

#include <span>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// Mean of a lattice of points in the region; a point of the region nearest to it if the mean
/// itself lies outside (a lobe may be a shell).
/// @throws InvalidInput if the region is too thin or too small for a lattice of 40 steps
Vec3 innerCentre(const LobeRegion& region);

/// Length of a main bronchus in lungs of 3.5 l (Huang 2004), mm; 0 for Side::None.
double mainBronchusMm(Side side);

/// Length of a lobar bronchus in such lungs (Huang 2004), mm.
double lobarBronchusMm(Lobe lobe);

/// How large lungs are in comparison with those that published lengths of bronchi are of: the
/// factor of lengths, 1 for 3.5 l a lung (Weibel's), from the volume of all regions.
double bronchialScale(std::span<const LobeRegion> lobes);

/// Where a straight bronchus from `from` towards `centre` of a lobe ends: after `lengthMm`, or as
/// much later as it takes to be inside, and then `furtherMm` deeper, so that its daughters start
/// well inside. Never beyond the centre.
Vec3 lobarEnd(const Domain& lobe, const Vec3& from, const Vec3& centre, double lengthMm,
              double furtherMm);

/// Airways of which every lobe has an end inside it.
struct LedAirways {
  AirwayTree airways;
  std::vector<Lobe> lobes;  ///< those that had no end inside; empty if nothing was added
};

/// Leads a straight airway into every lobe that no end of `central` lies inside, as airways found
/// in CTs of thick slices often end before the lobes: from an end that is marked with the lobe
/// and lies in no other, else from the point of its lung's airways nearest to the lobe's centre
/// that lies in no lobe and is as far from the carina as a main bronchus is long (Huang 2004); the
/// branch is divided there. What is added has Origin::Template and 2^(-1/3) of the radius of the
/// branch it leaves. Nothing is added if no end lies inside any lobe: such airways are of another
/// person or frame, and assignLobes() refuses them.
LedAirways ledIntoLobes(const AirwayTree& central, std::span<const LobeRegion> lobes);

}  // namespace pneuma
