#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/landmark_pair.h"
#include "core/image.h"

namespace pneuma {

/// The scans that landmarks were counted in, voxel by voxel.
struct LandmarkVoxels {
  ImageGeometry rest;
  ImageGeometry moved;
  int first = 1;  ///< number of the first voxel along each axis: 1 in DIR-Lab's files, or 0
};

/// Reads pairs of landmarks from a CSV whose first line names columns of coordinates in mm,
/// <name>_x, <name>_y, <name>_z. The places at rest are those of exp or ee (end of expiration), the
/// moved ones those of ei_refined, else ei or insp (end of inspiration). Other columns are left
/// out. The axes are the file's; which lung a landmark lies in is not said.
/// @throws InputMissing; InvalidInput naming file and line: no such columns, a line with more or
/// fewer values than columns, a value that is no finite number, no landmark at all
std::vector<LandmarkPair> readLandmarkPairs(const std::filesystem::path& path);

/// The same from more kinds of files: one with six numbers in a line or with columns as above
/// (<name>_i, _j, _k for voxels), or two, the places at rest and the moved ones, with three numbers
/// in a line, as DIR-Lab's. Two files may begin with a line "x,y,z" or "i,j,k"; numbers are parted
/// by commas or blanks.
/// @param voxels that the numbers count; nothing: they are mm, LPS
/// @throws as above; InvalidInput if a voxel lies outside of its scan, columns say mm where voxels
/// are wanted or the other way round, or two files have unequal numbers of landmarks
std::vector<LandmarkPair> readLandmarkPairs(std::span<const std::filesystem::path> paths,
                                            const std::optional<LandmarkVoxels>& voxels);

}  // namespace pneuma
