#include "pipeline/run_project.h"

#include <chrono>
#include <utility>

#include "core/error.h"
#include "core/seconds.h"
#include "pipeline/ct_model.h"
#include "pipeline/detail/run_lobes.h"
#include "pipeline/lobes_model.h"
#include "pipeline/lung_edits_file.h"
#include "pipeline/whole_lungs.h"

namespace pneuma {
namespace {

/// Does a step of a model, and tells its time and what it warned of.
template <class Step>
void doStage(Stage stage, LungModel& model, std::vector<StageResult>& results, const Step& step) {
  const auto start = std::chrono::steady_clock::now();
  const std::size_t before = model.warnings.size();
  model = step();
  StageResult result{stage, StageState::Done, secondsSince(start), {}, {}};
  if (model.warnings.size() > before) {
    result.warnings.assign(model.warnings.begin() + static_cast<std::ptrdiff_t>(before),
                           model.warnings.end());
  }
  results.push_back(std::move(result));
}

LobeEdits editsOf(const LobesRecipe& recipe, const LobeInputs& inputs, const LungModel& model) {
  std::vector<std::shared_ptr<const LungShape>> lungs;
  for (const LobeSurface& surface : *model.surfaces) {
    lungs.push_back(std::make_shared<const LungShape>(lungShape(surface.mesh, side(surface.lobe))));
  }
  LobeEdits edits;
  edits.fissures = editsOf(inputs.given, lungs);
  edits.options = recipe.options;
  edits.shares = inputs.shares;
  edits.snap = recipe.snap;
  return edits;
}

}  // namespace

Project projectOfRecipe(const Recipe& recipe, Stage upTo, std::vector<StageResult>& results,
                        const Progress& progress) {
  LobeInputs inputs;
  if (recipe.split) inputs = lobeInputs(recipe.lobes);
  if (!inputs.accessory.empty()) {
    throw Unsupported("a project has no accessory fissures; run the recipe into a folder");
  }
  std::vector<LungEdit> edits;
  if (!recipe.lungEdits.empty()) edits = readLungEdits(recipe.lungEdits);
  Project project;
  LungModel& model = project.state.model;
  doStage(Stage::Open, model, results, [&] {
    CtFile file = readCt(recipe.ct, recipe.corrections, progress.part(0.0, 0.1, "reading the CT"),
                         recipe.series);
    if (recipe.split && recipe.lobes.snap) requireThinSlices(file.image);
    requireWithin(edits, file.image.geometry, recipe.lungEdits);
    LungModel opened =
        modelOf(std::move(file), {recipe.ct, recipe.corrections, recipe.series.wanted, 0, {}});
    project.state.name =
        (recipe.ct.has_filename() ? recipe.ct : recipe.ct.parent_path()).filename().string();
    return opened;
  });
  if (upTo >= Stage::Lungs) {
    doStage(Stage::Lungs, model, results, [&] {
      project.state.lungOptions = project.next.lungs = recipe.lungs;
      return untangled(withSurfaces(
          withLungEdits(
              withLungs(model, recipe.lungs, progress.part(0.1, 0.35, "finding the lungs")), edits,
              recipe.lungEdits, recipe.lungs.thresholdHu,
              progress.part(0.35, 0.4, "correcting the lungs")),
          recipe.surfaces, progress.part(0.4, 0.5, "drawing surfaces")));
    });
  }
  if (upTo >= Stage::Lobes && recipe.split) {
    doStage(Stage::Lobes, model, results, [&] {
      project.state.lobeEdits = project.state.splitEdits = editsOf(recipe.lobes, inputs, model);
      if (recipe.lobes.snap) inputs.snap = recipe.lobes.snapOptions;
      return withLobes(model, inputs, recipe.lobes.options,
                       progress.part(0.5, 0.7, "splitting the lungs"));
    });
  }
  for (const GrowthMethod& method : growthMethods()) project.next.growth.push_back(method.defaults);
  project.next.method = recipe.growth.index();
  project.next.growth[project.next.method] = recipe.growth;
  if (upTo >= Stage::Airways && recipe.grow) {
    doStage(Stage::Airways, model, results,
            [&] { return grow(model, recipe.growth, progress.part(0.7, 1.0, "growing")); });
    results.back().warnings.insert(results.back().warnings.end(),
                                   model.growth->result.warnings.begin(),
                                   model.growth->result.warnings.end());
    project.state.grownIn = model.surfaces;
  }
  progress.report(1.0);
  return project;
}

}  // namespace pneuma
