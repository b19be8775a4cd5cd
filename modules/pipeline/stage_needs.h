#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "io/json.h"

namespace pneuma {

/// What one stage of a case takes of a machine.
struct StageNeed {
  std::string_view stage;   ///< "import", "segment", ...: as the workflow of a cohort calls it
  std::uint64_t bytes = 0;  ///< the most that it holds at once, program and libraries included
  double seconds = 0.0;     ///< of one core
  int threads = 1;          ///< that are of use
};

/// What the stages take for a CT, from reading it to the report, in their order. A law of its
/// voxels and of those that large lungs take of it, fitted to synthetic chests of 5, 55 and 112
/// million voxels and to four real CTs, one of them cropped to the lungs, and rounded up
/// (docs/cohort-plan.md has what was measured); memory of trees is that of the methods' defaults.
/// @param sideMm of the voxels to which it is resampled as it is imported: `info` reads it as it
/// is, `import` holds both; 0: it is not resampled
std::vector<StageNeed> stageNeeds(const ImageGeometry& geometry, double sideMm);

/// The need of one stage. @throws std::out_of_range if there is no such stage
StageNeed stageNeed(std::string_view stage, const ImageGeometry& geometry, double sideMm);

/// {"segment": {"memory_mb": 574, "seconds": 13, "threads": 1}, ...}
Json toJson(std::span<const StageNeed> needs);

/// The voxels of a CT after it was resampled. @param sideMm 0: it is not
double voxelsAt(const ImageGeometry& geometry, double sideMm);

/// The least side of cubic voxels, in tenths of a millimetre, at which a stage fits into `bytes`.
/// Empty if none up to 5 mm does, or reading the CT as it is takes more already.
std::optional<double> sideThatFits(std::string_view stage, const ImageGeometry& geometry,
                                   std::uint64_t bytes);

/// Ends work that would not fit before it starts.
/// @param what  starts the sentence: "finding the lungs"
/// @throws Error (OutOfMemory) if the stage takes more than is left to the process; names the
/// voxels' side that would fit
void requireStageFits(std::string_view stage, const std::string& what,
                      const ImageGeometry& geometry, double sideMm);

}  // namespace pneuma
