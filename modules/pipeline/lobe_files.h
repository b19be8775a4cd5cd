#pragma once

#include <filesystem>
#include <vector>

#include "anatomy/fissure.h"
#include "anatomy/lobe.h"
#include "pipeline/split_lobes.h"

namespace pneuma {

// Names of what `pneuma lobes` writes into its folder.
inline constexpr const char* LobesReportFile = "lobes.json";
inline constexpr const char* LobeLabelsFile = "labels.nii.gz";
inline constexpr const char* LobesTogetherFile = "lobes.vtm";
inline constexpr const char* FissurePointsFile = "fissures.json";

/// "rul.vtp", ...
std::filesystem::path lobeFile(Lobe lobe);

/// "fissures/right-oblique.vtp", ...
std::filesystem::path patchFile(Fissure fissure);

/// What writeLobes() writes for lungs of these sides, or for a model's, relative to the folder.
std::vector<std::filesystem::path> lobeOutputs(const std::vector<Side>& sides,
                                               const LobeInputs& inputs);
std::vector<std::filesystem::path> lobeOutputs(const LungModel& model, const LobeInputs& inputs);

/// Writes lobes, fissures, labels and the report into a folder, and the fissures that were given.
/// @pre the folders of lobeOutputs() are there
/// @throws OutputFailed, Cancelled: what was written before stays
void writeLobes(const std::filesystem::path& folder, const LobesOfLungs& lobes,
                const LabelImage& labels, const LobeInputs& inputs, const Json& report,
                const Progress& progress = {});

}  // namespace pneuma
