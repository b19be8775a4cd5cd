#pragma once

#include <span>
#include <vector>

#include "anatomy/central_airways.h"
#include "growth/region_grower.h"

namespace pneuma {

/// At a bifurcation that is given, rule 4a's half-planes follow from the directions of the two
/// daughters: the plane through the parent's axis behind the branching point, the bisector of the
/// daughters in front of it. The side of daughter a.
/// @param directionA, directionB unit vectors
Wedge givenSide(const Stem& stem, const Vec3& directionA, const Vec3& directionB);

/// What every inlet grows from: each lobe is divided among its inlets on the way down the central
/// tree, at the bifurcations where both daughters lead to inlets of the lobe. Flow is the share of
/// the volume of all lobes; an inlet that gets no room has flow 0.
/// @throws InvalidInput if a lobe is too thin for the grid
std::vector<Sprout> inletSprouts(const AirwayTree& central, std::span<const Inlet> inlets,
                                 std::span<const LobeRegion> lobes, const KitaokaOptions& options);

/// A unit vector normal to `direction` along which `box` is widest: the first branching plane
/// contains it.
Vec3 widestAcross(const Box3& box, const Vec3& direction);

}  // namespace pneuma
