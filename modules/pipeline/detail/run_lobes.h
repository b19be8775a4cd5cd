#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/recipe.h"
#include "pipeline/split_lobes.h"

namespace pneuma {

/// What the stage "lobes" of a recipe splits lungs with. Its files are read.
/// @throws as readFissureFile() and lobeSharesOfText()
LobeInputs lobeInputs(const LobesRecipe& recipe);

/// One hash of the options and of all files that they name.
std::string contentKey(const LobesRecipe& recipe);

/// What the stage writes for both lungs, relative to the folder of the run.
std::vector<std::string> runLobeFiles(const LobeInputs& inputs);

/// Splits lungs and writes what `pneuma lobes` writes, into `lobes` below a folder `aside`, from
/// where it is moved into the `folder` of the run.
/// @param model with surfaces of whole lungs and labels of the same CT; with the CT itself if it is
/// to be looked at
/// @param warnings gets whole sentences
/// @return files relative to the folder of the run
std::vector<std::string> writeRunLobes(const std::filesystem::path& folder,
                                       const std::filesystem::path& aside, const LungModel& model,
                                       const LobesRecipe& recipe, const LobeInputs& inputs,
                                       std::vector<std::string>& warnings,
                                       const Progress& progress);

}  // namespace pneuma
