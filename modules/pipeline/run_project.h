#pragma once

#include <vector>

#include "core/progress.h"
#include "pipeline/project.h"
#include "pipeline/run_recipe.h"

namespace pneuma {

/// What a recipe makes as one project: CT, lungs and central airways, lobes, a grown tree. Nothing
/// is kept of a run before, and the recipe's export does not matter: `pneuma export` does it.
/// @param upTo the last stage that is done
/// @param results gets what became of every stage
/// @throws as readCt(), segmentLungs(), splitLobes(), growAirways(); Unsupported for accessory
/// fissures; Cancelled
Project projectOfRecipe(const Recipe& recipe, Stage upTo, std::vector<StageResult>& results,
                        const Progress& progress = {});

}  // namespace pneuma
