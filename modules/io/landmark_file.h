#pragma once

#include <filesystem>
#include <vector>

#include "anatomy/landmark_pair.h"

namespace pneuma {

/// Reads pairs of landmarks from a CSV whose first line names columns of coordinates in mm,
/// <name>_x, <name>_y, <name>_z. The places at rest are those of exp or ee (end of expiration), the
/// moved ones those of ei_refined, else ei or insp (end of inspiration). Other columns are left
/// out. The axes are the file's; which lung a landmark lies in is not said.
/// @throws InputMissing; InvalidInput naming file and line: no such columns, a line with more or
/// fewer values than columns, a value that is no finite number, no landmark at all
std::vector<LandmarkPair> readLandmarkPairs(const std::filesystem::path& path);

}  // namespace pneuma
