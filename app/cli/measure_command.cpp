#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/region_arguments.h"
#include "cli/text.h"
#include "io/tree_file.h"
#include "pipeline/efficiency_report.h"
#include "pipeline/measure_report.h"
#include "pipeline/report.h"
#include "pipeline/tree_measurement.h"

namespace pneuma::cli {
namespace {

struct MeasureArguments : RegionArguments {
  std::filesystem::path tree;
  bool csv = false;
};

Json measureReport(const MeasureArguments& arguments, const TreeFile& file, const LungModel& organ,
                   const TreeMeasurement& measured) {
  std::vector<InputFile> inputs = {inputFile(arguments.tree)};
  inputs.insert(inputs.end(), organ.inputs.begin(), organ.inputs.end());
  Json report = reportEnvelope("pneuma/measure/1", inputs, parametersOf(arguments), arguments.seed);
  report["checks"] = checksOf(measured);
  for (const std::string& note : file.notes) report["warnings"].push_back(note);
  for (const std::string& warning : organ.warnings) report["warnings"].push_back(warning);
  report.update(toJson(measured));
  report["published"] = publishedJson(measured.whole);
  return report;
}

std::string textOf(const TreeMeasurement& measured) {
  std::string text = measureText(measured.whole, measured.byLobe);
  if (measured.efficiency.has_value()) text += "\n" + efficiencyText(*measured.efficiency);
  return text;
}

ExitCode runMeasure(const MeasureArguments& arguments, const CommonOptions& common,
                    const Progress& progress) {
  if (arguments.csv && common.json) throw InvalidOption("measure takes --csv or --json, not both");
  requireOneRegion(arguments, "measure");
  if (!common.output.empty()) requireOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, {&arguments.tree, 1});
  const TreeFile file = readTree(arguments.tree);
  const LungModel organ = opened(arguments, progress.part(0.0, 0.3, "reading"));
  const TreeMeasurement measured =
      measureTree(file.tree, organ, arguments.seed, progress.part(0.3, 1.0, "measuring"));
  progress.report(1.0);
  const Json report = measureReport(arguments, file, organ, measured);
  const std::string text = common.json     ? jsonText(report)
                           : arguments.csv ? measureCsv(measured.whole, measured.byLobe)
                                           : textOf(measured);
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.output.empty()) {
    std::cout << text;
  } else {
    writeFile(common.output, text, common.existing());
  }
  const std::string failed = failedChecks(report);
  std::cerr << failed;
  return failed.empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareMeasure(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<MeasureArguments>();
  app.add_option("TREE", arguments->tree, "A tree: VTP, VTU, SWC, CSV or JSON.")
      ->type_name("FILE")
      ->required();
  addRegionArguments(app, *arguments);
  app.add_flag("--csv", arguments->csv, "Print the figures as CSV.");
  addJson(app, common);
  addOutput(app, common, "FILE", "Write the result here instead of standard output.");
  return [arguments, &common](const Progress& progress) {
    return runMeasure(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
