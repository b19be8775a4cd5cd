#pragma once

#include <vector>

#include "core/progress.h"
#include "io/detail/volume_formats.h"

/// The voxels behind readHuVolume() and readLabelVolume().
namespace pneuma {

/// @throws InputMissing, InvalidInput if the data file is not there or cannot hold the voxels; no
/// voxel is read
void requireRoomForVoxels(const VolumeLayout& layout);

// All voxels, straight into their place: the file's and the result never stand in memory together.
// @throws as readHuVolume and readLabelVolume
std::vector<std::int16_t> huVoxels(const VolumeLayout& layout, const Progress& progress);
std::vector<std::uint8_t> labelVoxels(const VolumeLayout& layout, const Progress& progress);

}  // namespace pneuma
