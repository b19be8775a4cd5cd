#pragma once

#include "anatomy/airway_tree.h"
#include "core/progress.h"
#include "segmentation/airway_segmentation.h"

namespace pneuma {

/// The centreline of an airway mask as a tree, root first, with radii in mm (Origin::Measured).
///
/// Shortest paths from the root, a step costing its length over the square of the distance to the
/// wall, so that they run in the middle. The farthest voxel not covered yet begins a path back to
/// the tree; balls about its points cover what belongs to it, wider where the airway is wide, so
/// that no spur grows out of a main bronchus. What ends less than two slices (5 mm at least) beyond
/// its parent's wall is no branch. A tree by construction: no loops.
/// Points are smoothed over about a slice.
AirwayTree airwayCentreline(const ImageGeometry& geometry, const AirwayMask& mask,
                            const Progress& progress = {});

}  // namespace pneuma
