#include "pipeline/detail/run_lobes.h"

#include "io/atomic_file.h"
#include "io/fissure_file.h"
#include "io/input_files.h"
#include "pipeline/lobe_files.h"
#include "pipeline/lobe_labels.h"
#include "pipeline/lobe_shares.h"
#include "pipeline/run_recipe.h"

namespace pneuma {
namespace {

std::string belowRun(const std::filesystem::path& file) {
  return (std::filesystem::path(run_files::Lobes) / file).generic_string();
}

/// Surfaces are named by their path from the file that names them. That file is written into
/// `aside` and moved into `folder`: its surfaces, as they are from there.
LobeInputs namedFrom(const std::filesystem::path& folder, const std::filesystem::path& aside,
                     LobeInputs inputs) {
  const auto name = [&](GivenFissure& given) {
    if (!given.patch) return;
    std::error_code unknown;
    const auto file = std::filesystem::proximate(given.patch->file, folder, unknown);
    if (!unknown && file.is_relative()) given.patch->file = aside / file;
  };
  for (auto& [fissure, given] : inputs.given) name(given);
  for (AccessoryFissure& accessory : inputs.accessory) name(accessory.fissure);
  return inputs;
}

}  // namespace

LobeInputs lobeInputs(const LobesRecipe& recipe) {
  LobeInputs inputs;
  inputs.shares = lobeSharesOfText(recipe.fractions);
  if (recipe.snap) inputs.snap = recipe.snapOptions;
  if (recipe.fissures.empty()) return inputs;
  FissureFile file = readFissureFile(recipe.fissures);
  inputs.given = std::move(file.fissures);
  inputs.accessory = std::move(file.accessory);
  return inputs;
}

std::string contentKey(const LobesRecipe& recipe) {
  std::string all = toJson(recipe.options).dump() + toJson(recipe.snapOptions).dump() +
                    recipe.fractions + (recipe.snap ? "snap" : "");
  if (!recipe.fissures.empty()) {
    all += sha256OfFile(recipe.fissures);
    for (const auto& patch : patchFiles(readFissureFile(recipe.fissures))) {
      all += sha256OfFile(patch);
    }
  }
  return sha256(all);
}

std::vector<std::string> runLobeFiles(const LobeInputs& inputs) {
  std::vector<std::string> files;
  for (const auto& file : lobeOutputs({Side::Right, Side::Left}, inputs)) {
    files.push_back(belowRun(file));
  }
  return files;
}

std::vector<std::string> writeRunLobes(const std::filesystem::path& folder,
                                       const std::filesystem::path& aside, const LungModel& model,
                                       const LobesRecipe& recipe, const LobeInputs& inputs,
                                       std::vector<std::string>& warnings,
                                       const Progress& progress) {
  const LobesOfLungs lobes =
      splitLobes(model, inputs, recipe.options, progress.part(0.0, 0.8, "splitting lungs"));
  const Progress writing = progress.part(0.8, 1.0, "writing lobes");
  const LabelImage labels = lobeLabels(*model.labels, lobes, writing);
  Json report = lobesReport(model, lobes, recipe.options);
  if (recipe.snap) report["parameters"].update(toJson(recipe.snapOptions));
  warnings = report.at("warnings").get<std::vector<std::string>>();
  std::vector<std::string> files;
  for (const auto& file : lobeOutputs(model, inputs)) {
    files.push_back(belowRun(file));
    makeFolder((aside / files.back()).parent_path());
  }
  const auto written = aside / run_files::Lobes;
  writeLobes(written, lobes, labels, namedFrom(folder / run_files::Lobes, written, inputs), report,
             writing);
  return files;
}

}  // namespace pneuma
