#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "segmentation/voxel_box.h"

namespace pneuma {

/// Divides a set of voxels in two or more where it is thinnest: every voxel goes to the marker that
/// reaches it first when the set is flooded from its widest places down (a watershed of the
/// distance to the outside).
/// @param distance2 square of the distance to the outside, 0 outside the set; of the box
/// @param marks one byte a voxel of the box: nonzero where a marker stands; filled in on return
void floodByDistance(const VoxelBox& box, const std::vector<float>& distance2,
                     std::vector<std::uint8_t>& marks, const Progress& progress = {});

/// How the two lungs were told apart.
struct Separation {
  bool done = false;
  double radiusMm = 0.0;  ///< of the widest bridge that was cut; 0 if there was none
};

/// Marks the lungs of one component that is both of them, 1 to the right of `middle` and 2 to the
/// left: raises a radius until what is farther from the outside than it falls into two large parts
/// on both sides, and floods back from these.
/// @param set nonzero in the component, over `box`; 1 and 2 on return where it succeeds
/// @param middle voxel coordinate along i between the lungs, in the image
Separation separateLungs(const VoxelBox& box, const Vec3& spacing, double middle,
                         std::vector<std::uint8_t>& set, const Progress& progress = {});

}  // namespace pneuma
