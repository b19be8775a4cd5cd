#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/json.h"
#include "pipeline/fissure_surfaces.h"

namespace pneuma {

/// A lobe that one more fissure parts.
struct PartedLobe {
  std::string name;  ///< of the fissure
  Lobe lobe = Lobe::Whole;
  UsedFissure used;
  SplitReport report;
  TriangleMesh below;  ///< closed; they share the triangles of `patch`
  TriangleMesh above;
  TriangleMesh patch;
  double lobeMm3 = 0.0;
  double belowMm3 = 0.0;
  double aboveMm3 = 0.0;
};

/// Parts copies of lobes along accessory fissures, one by one: the lobes stay whole.
/// @param warnings gets whole sentences
/// @throws InvalidInput if a lobe is not there, and as accessorySurface() and splitRegion();
/// Cancelled
std::vector<PartedLobe> partedLobes(const std::vector<SplitLung>& lungs,
                                    const std::vector<AccessoryFissure>& fissures,
                                    const LobeOptions& options, std::vector<std::string>& warnings,
                                    const Progress& progress = {});

/// What writePartedLobes() writes, relative to the folder: accessory/NAME_below.vtp,
/// accessory/NAME_above.vtp, fissures/NAME.vtp.
std::vector<std::filesystem::path> partedLobeFiles(const std::vector<AccessoryFissure>& fissures);

/// @pre the folder has "accessory" and "fissures" in it. @throws OutputFailed
void writePartedLobes(const std::filesystem::path& folder, const std::vector<PartedLobe>& lobes);

/// Adds "accessory" and its checks to the report of `pneuma lobes`, if there are any.
void addPartedLobes(Json& report, const std::vector<PartedLobe>& lobes);

}  // namespace pneuma
