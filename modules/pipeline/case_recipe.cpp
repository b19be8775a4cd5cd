#include "pipeline/case_recipe.h"

#include <string>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"
#include "pipeline/detail/run_folder.h"
#include "pipeline/lobe_shares.h"
#include "pipeline/lung_corrections.h"
#include "pipeline/lung_edits_file.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr const char* RecipeFile = "recipe.json";
constexpr const char* FissuresFile = "fissures.json";
constexpr const char* LungEditsFile = "lung-edits.json";

fs::path patchFileOf(Fissure fissure) { return std::string(shortName(fissure)) + ".vtp"; }

}  // namespace

bool hasRecipe(const ProjectState& state) {
  return state.model.ctSource != nullptr && state.model.lungs != nullptr;
}

CaseRecipe recipeOf(const ProjectState& state) {
  if (!hasRecipe(state)) {
    throw InvalidInput("a recipe begins with a CT in which lungs are found; this case has none");
  }
  const LungModel& model = state.model;
  CaseRecipe made;
  Recipe& recipe = made.recipe;
  recipe.ct = fs::absolute(model.ctSource->path);
  recipe.series.wanted = model.ctSource->series;
  recipe.corrections = model.ctSource->corrections;
  recipe.lungs = state.lungOptions;
  if (model.corrections) made.lungEdits = model.corrections->edits;
  if (!made.lungEdits.empty()) recipe.lungEdits = LungEditsFile;
  recipe.split = model.lobes != nullptr;
  if (recipe.split) {
    recipe.lobes.options = state.splitEdits.options;
    recipe.lobes.snap = state.splitEdits.snap;
    recipe.lobes.fractions = textOfLobeShares(state.splitEdits.shares);
    made.fissures = givenOf(state.splitEdits);
    if (!made.fissures.empty()) recipe.lobes.fissures = FissuresFile;
  }
  recipe.grow = model.growth != nullptr;
  if (recipe.grow) recipe.growth = model.growth->options;
  return made;
}

std::vector<fs::path> recipeFiles(const ProjectState& state) {
  const CaseRecipe made = recipeOf(state);
  std::vector<fs::path> files = {RecipeFile};
  if (!made.lungEdits.empty()) files.emplace_back(LungEditsFile);
  if (!made.fissures.empty()) files.emplace_back(FissuresFile);
  for (const auto& [fissure, given] : made.fissures) {
    if (given.patch) files.push_back(patchFileOf(fissure));
  }
  return files;
}

void writeRecipe(const fs::path& folder, const ProjectState& state) {
  const CaseRecipe made = recipeOf(state);
  writeFile(folder / RecipeFile, textOf(toJson(made.recipe)));
  if (!made.lungEdits.empty()) writeFile(folder / LungEditsFile, lungEditsText(made.lungEdits));
  if (!made.fissures.empty()) writeGivenFissures(folder / FissuresFile, made.fissures);
}

void writeGivenFissures(const fs::path& file, GivenFissures given) {
  for (auto& [fissure, one] : given) {
    if (!one.patch) continue;
    one.patch->file = file.parent_path() / patchFileOf(fissure);
    writeSurface(one.patch->file, *one.patch->mesh);
  }
  writeFissures(file, given);
}

}  // namespace pneuma
