#pragma once

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "io/fissure_file.h"
#include "pipeline/project.h"
#include "pipeline/recipe.h"
#include "segmentation/lung_edits.h"

namespace pneuma {

/// What was done with a case, for `pneuma run` to do it again.
struct CaseRecipe {
  Recipe recipe;                    ///< its fissures are in a file of their own
  GivenFissures fissures;           ///< those that were set; the others are proposed again
  std::vector<LungEdit> lungEdits;  ///< corrections of the lungs by hand, in a file too
};

/// Can a recipe say how this case was made? Only from a CT whose lungs were found, not read.
bool hasRecipe(const ProjectState& state);

/// With the options of every stage that the case has gone through.
/// @throws InvalidInput where hasRecipe() is false
CaseRecipe recipeOf(const ProjectState& state);

/// The files that writeRecipe() writes: recipe.json, and fissures.json with the surfaces it names
/// and lung-edits.json where there are such.
std::vector<std::filesystem::path> recipeFiles(const ProjectState& state);

/// Writes them. The path of the CT stands in recipe.json as it is, or it would not be found.
/// @throws as recipeOf(); OutputFailed
void writeRecipe(const std::filesystem::path& folder, const ProjectState& state);

/// Writes fissures as JSON, with the surfaces that some are given by beside it.
/// @throws OutputFailed
void writeGivenFissures(const std::filesystem::path& file, GivenFissures given);

}  // namespace pneuma
