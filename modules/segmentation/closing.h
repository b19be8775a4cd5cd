#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "segmentation/voxel_box.h"

namespace pneuma {

/// Morphological closing by a ball, exact in mm whatever the voxels' shape: vessels and the hilum
/// become part of a lung without its outline moving. Beyond the box nothing counts as background.
/// @param set one byte a voxel of a box of `size`, nonzero where set
/// @param progress for stopping alone, here and below
/// @throws Cancelled
void closeByBall(std::vector<std::uint8_t>& set, const std::array<int, 3>& size,
                 const Vec3& spacing, double radiusMm, const Progress& progress = {});

/// Sets every voxel from which no way leads to a face of the box.
void fillHoles(std::vector<std::uint8_t>& set, const std::array<int, 3>& size,
               const Progress& progress = {});

/// Clears all but the largest component. Returns the number of voxels that stay.
std::size_t keepLargest(std::vector<std::uint8_t>& set, const std::array<int, 3>& size,
                        const Progress& progress = {});

/// The box of all voxels with one label, `marginMm` larger on every side. In plane it may reach
/// beyond the image, since something is there; above and below it ends with the slices, since a
/// lung may go on there. Its size is 0 if there is no such voxel.
VoxelBox boxOf(const LabelImage& labels, std::uint8_t label, double marginMm);

/// The voxels of a box, one byte each: 1 where they carry a label, else 0.
std::vector<std::uint8_t> maskOf(const LabelImage& labels, std::uint8_t label, const VoxelBox& box);

}  // namespace pneuma
