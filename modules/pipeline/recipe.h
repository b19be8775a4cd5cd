#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "growth/growth.h"
#include "io/ct_file.h"
#include "io/json.h"
#include "lobes/lobe_splitting.h"
#include "pipeline/fissure_snapping.h"
#include "pipeline/fissure_surfaces.h"
#include "segmentation/label_surface.h"
#include "segmentation/lung_segmentation.h"

namespace pneuma {

/// The steps from a CT to a tree, in their order. What one makes the next ones read.
enum class Stage { Open, Lungs, Lobes, Airways, Export };

constexpr auto choices(Stage) {
  return std::array<std::string_view, 5>{"open", "lungs", "lobes", "airways", "export"};
}

/// How lungs are split: as `pneuma lobes` does it.
struct LobesRecipe {
  std::filesystem::path fissures;  ///< empty: proposed
  std::string fractions;           ///< as lobeSharesOfText() takes them
  bool snap = false;               ///< onto what shows in the CT
  LobeOptions options;
  SnapOptions snapOptions;
};

/// What `pneuma run` does with a CT: the options of every stage. Everything has a default.
struct Recipe {
  std::filesystem::path ct;
  SeriesChoice series;
  CtCorrections corrections;
  LungOptions lungs;
  SurfaceOptions surfaces;
  std::filesystem::path lungEdits;  ///< corrections of the lungs by hand; empty: none
  LobesRecipe lobes;
  GrowthOptions growth = growthMethods().front().defaults;
  bool split = true;                 ///< into lobes; false: airways grow in whole lungs
  bool grow = true;                  ///< false: the recipe ends with the lungs or lobes
  std::vector<std::string> formats;  ///< of the grown tree, besides VTP: "swc", "csv", "json"
};

/// Reads a recipe ("pneuma/recipe/1", resources/schemas/recipe.schema.json):
/// {"schema": "pneuma/recipe/1", "open": {"ct": PATH, ...}, "lungs": {"edits": PATH, ...},
///  "lobes": {"fissures": PATH, ...}, "airways": {"method": NAME, ...}, "export": {"tree": [...]}}.
/// Paths are relative to the recipe.
/// @throws InputMissing, InvalidInput (no JSON, another schema, an unknown stage or key, naming the
/// nearest), InvalidOption (out of range), Unsupported (stages that are to come)
Recipe readRecipe(const std::filesystem::path& path);

/// The recipe as it would stand in a file, defaults included.
Json toJson(const Recipe& recipe);

}  // namespace pneuma
