#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "pipeline/breathe.h"
#include "pipeline/breathe_files.h"

namespace pneuma::cli {
namespace {

struct BreatheArguments {
  std::vector<std::filesystem::path> inputs;
  BreatheOptions options;
};

std::string summary(const Json& report, const std::filesystem::path& output) {
  const Json& breath = report.at("breath");
  const auto ml = [](const Json& value) { return fixed(value.get<double>(), 0) + " ml"; };
  std::string text = output.string() + ": " + report.at("scenario").get<std::string>() + ", " +
                     ml(breath.at("tidal_ml")) + " in " +
                     fixed(breath.at("period_s").get<double>(), 1) + " s\n";
  std::vector<std::vector<std::string>> rows = {{"lung", "at rest", "least", "most"}};
  for (const Json& lung : report.at("lungs")) {
    rows.push_back({lung.at("lung").get<std::string>(), ml(lung.at("rest_ml")),
                    ml(lung.at("least_ml")), ml(lung.at("most_ml"))});
  }
  return text + table(rows) + report.at("basis").get<std::string>() + "\n" + failedChecks(report);
}

ExitCode runBreathe(const BreatheArguments& arguments, const CommonOptions& common,
                    const Progress& progress) {
  if (common.output.extension() != ".pvd") {
    throw Unsupported("breaths are written for ParaView; '" + common.output.string() +
                      "' should end in .pvd");
  }
  requireOutput(common.output, common.existing());
  const LungModel model = openFiles(expanded(arguments.inputs), progress.part(0.0, 0.2, "reading"));
  const std::filesystem::path folder = common.output.parent_path();
  std::vector<std::filesystem::path> paths;
  for (const auto& file :
       breathOutputs(common.output, arguments.options.frames, treeOf(model) != nullptr)) {
    paths.push_back(folder / file);
    requireOutput(paths.back(), common.existing());
    requireOtherThanInputs(paths.back(), arguments.inputs);
  }
  const BreathingLungs lungs =
      breathe(model, arguments.options, progress.part(0.2, 0.7, "breathing"));
  const Json report = breatheReport(model, lungs, arguments.options);
  OutputSet outputs;
  for (const auto& path : paths) outputs.add(path);
  writeBreath(common.output, lungs, report, progress.part(0.7, 1.0, "writing"));
  outputs.keep();
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << summary(report, common.output);
  }
  return failedChecks(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareBreathe(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<BreatheArguments>();
  addFiles(app, "LOBES", arguments->inputs,
           "Surfaces of lobes or of whole lungs at the end of expiration, or a folder of them, and "
           "the airways that were grown in them if they shall move too.")
      ->required();
  addFields(app, arguments->options);
  addOutput(app, common, "FILE",
            "The collection for ParaView (.pvd). Beside it: a VTP for every frame, of the airways "
            "too, a .vtp.series, the table of volumes and pressures (.csv) and the report (.json).")
      ->required();
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runBreathe(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
