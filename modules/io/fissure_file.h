#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "anatomy/fissure.h"
#include "core/math.h"

namespace pneuma {

/// Points that were set upon a fissure, LPS, mm.
struct FissurePoints {
  std::vector<Vec3> points;
  std::vector<double> weights;  ///< of the points; empty: all the same
};

using FissurePointSets = std::map<Fissure, FissurePoints>;

/// Reads points of fissures: our JSON (schema pneuma/fissures/1) or the CSV of the Chest Imaging
/// Platform (columns region, type, x, y, z; RIGHTLUNG or LEFTLUNG, OBLIQUEFISSURE or
/// HORIZONTALFISSURE; other rows are left out).
/// @throws InputMissing; InvalidInput naming file and row or entry; Unsupported for another format
FissurePointSets readFissures(const std::filesystem::path& path);

/// Writes our JSON. @throws OutputFailed
void writeFissures(const std::filesystem::path& path, const FissurePointSets& fissures);

}  // namespace pneuma
