#pragma once

#include "core/image.h"
#include "segmentation/voxel_runs.h"

/// Steps of finding lungs in a CT. All of them take an upright one: i to the left, j to the back,
/// k up (turned(ct, patientAxes(ct.geometry))).
namespace pneuma {

/// Values below this stand for "not measured", whatever a scanner writes there.
inline constexpr int PaddingBelowHu = -1500;

/// Air inside the body: lungs, airways, stomach and bowel.
struct InnerAir {
  VoxelRuns runs;
  VoxelComponents inSlices;  ///< of the runs
  double bodyCentre = 0.0;   ///< where the body's middle lies along i, voxels
};

/// All voxels under the threshold that do not hang together with the border of their slice. Slice
/// by slice, so that an open mouth or a lung in the top slice lets nothing in.
///
/// What touches the border and yet has the density of lungs is a lung that the field of view cuts
/// off, and stays.
InnerAir findInnerAir(const CtImage& ct, double thresholdHu);

}  // namespace pneuma
