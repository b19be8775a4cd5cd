#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "pipeline/fissure_sampling.h"

namespace pneuma::cli {
namespace {

struct FissuresArguments {
  std::vector<std::filesystem::path> lobes;
  SampleFissuresOptions options;
};

ExitCode runFissures(const FissuresArguments& arguments, const CommonOptions& common,
                     const Progress& progress) {
  requireFissureFileName(common.output);
  requireOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, arguments.lobes);
  const LungModel model = openLobes(arguments.lobes, progress.part(0.0, 0.6, "reading surfaces"));
  const SampledFissures sampled =
      sampleFissures(model, arguments.options, progress.part(0.6, 1.0, "sampling fissures"));
  const Json report = fissureContactsReport(model, sampled, arguments.options);
  writeFissures(common.output, sampled.given);
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << fissureContactsText(sampled);
  }
  return ExitCode::Done;
}

}  // namespace

Run declareFissures(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<FissuresArguments>();
  addFiles(app, "LOBES", arguments->lobes,
           "Surfaces of lobes that touch, named rul, rml, rll, lul, lll, or a folder of them.")
      ->required();
  addFields(app, arguments->options);
  addOutput(app, common, "FILE",
            "Where the points go: .json for 'pneuma lobes --fissures', .mrk.json or .fcsv for 3D "
            "Slicer, .csv for the Chest Imaging Platform.")
      ->required();
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runFissures(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
