#pragma once

#include "anatomy/airway_tree.h"
#include "anatomy/predefined_airways.h"
#include "growth/kitaoka.h"

namespace pneuma {

/// Central airways of an organ from their table: at each bifurcation the region is divided by the
/// bent half-planes of rule 4a, flows follow from the cells on each side, diameters from the flows,
/// lengths from the diameters. Branches are Origin::Template; those named for a segment
/// (anatomy/segment.h) carry its number.
/// @throws InvalidInput if a parent is not there yet, or a daughter gets no room
AirwayTree growPredefined(const PredefinedAirways& table, const LobeRegion& organ,
                          const KitaokaOptions& options);

}  // namespace pneuma
