#include <chrono>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/growth_arguments.h"
#include "cli/text.h"
#include "core/seconds.h"
#include "io/tree_file.h"
#include "pipeline/aggregate_file.h"
#include "pipeline/efficiency_report.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

struct GrowArguments : GrowthArguments {
  std::filesystem::path report;
  std::filesystem::path points;  ///< where the raw aggregate goes; may be empty
};

/// `--points N` is an option of the method, `--points FILE` an output.
void setPoints(GrowArguments& arguments, const std::string& text) {
  const bool number = text.find_first_not_of("0123456789+-.eE") == std::string::npos;
  if (number) {
    arguments.shortcuts.push_back("points=" + text);
  } else {
    arguments.points = text;
  }
}

/// Throws now what could be thrown when the points are written.
void requirePointsOutput(const GrowArguments& arguments, const CommonOptions& common) {
  if (arguments.points.empty()) return;
  if (arguments.method != "dla") {
    throw InvalidOption("--points writes the particles of an aggregate, which --method " +
                        arguments.method + " does not make; use --method dla");
  }
  if (arguments.points.extension() != ".vtp") {
    throw Unsupported("points are written as VTP; '" + arguments.points.string() +
                      "' should end in .vtp");
  }
  requireOutput(arguments.points, common.existing());
  if (arguments.points == common.output || arguments.points == arguments.report) {
    throw InvalidOption("--points names the same file as another output, '" +
                        arguments.points.string() + "'");
  }
}

void requireUsable(const GrowArguments& arguments, const CommonOptions& common) {
  requireOneOrgan(arguments, "grow");
  requireTreeOutput(common.output, common.existing());
  requirePointsOutput(arguments, common);
  requireOtherThanInputs(common.output, {&arguments.central, 1});
  requireOtherThanInputs(common.output, arguments.lobes);
  if (arguments.report.empty()) return;
  requireOutput(arguments.report, common.existing());
  if (arguments.report == common.output) {
    throw InvalidOption("--report and --output name the same file '" + common.output.string() +
                        "'");
  }
}

/// The report's figures for people.
std::string summary(const Json& report, const Efficiency& efficiency, const std::string& output) {
  const auto count = [](const Json& value) { return grouped(value.get<double>()); };
  std::string text = output + ": " + count(report.at("branches")) + " branches, " +
                     count(report.at("terminals")) + " terminals, grown by " +
                     report.at("method").get<std::string>() + ", seed " + report.at("seed").dump() +
                     "\n";
  std::vector<std::vector<std::string>> rows = {{"region", "terminals", "branches", "volume"}};
  for (const auto& [name, lobe] : report.at("lobes").items()) {
    rows.push_back({name, count(lobe.at("terminals")), count(lobe.at("branches")),
                    fixed(lobe.at("volume_ml").get<double>(), 1) + " ml"});
  }
  text += table(rows);
  const Json& outside = report.at("outside");
  text += "outside their lobe: " + count(outside.at("ends")) + " ends, " +
          count(outside.at("segments")) + " branches\n";
  const Json& morphometry = report.at("morphometry");
  if (morphometry.contains("gap_mean")) {
    text += "distance to the nearest terminal: mean " +
            fixed(morphometry.at("gap_mean").get<double>(), 2) + ", largest " +
            fixed(morphometry.at("gap_max").get<double>(), 2) + " spacings\n";
  }
  text += efficiencyText(efficiency);
  text += "time:";
  for (const auto& [step, seconds] : report.at("timing_s").items()) {
    text += " " + step + " " + fixed(seconds.get<double>(), 2) + " s";
  }
  text += "; memory " + fixed(report.at("peak_memory_mb").get<double>(), 0) + " MB\n";
  return text + failedChecks(report);
}

ExitCode runGrow(const GrowArguments& arguments, const CommonOptions& common,
                 const Progress& progress) {
  requireUsable(arguments, common);
  const GrowthOptions options = growthOptions(arguments);
  const VariationOptions variation = variationOptions(arguments);
  const LungModel model = grow(
      varied(opened(arguments, progress.part(0.0, 0.3, "reading")), variation, seedOf(options)),
      options, progress.part(0.3, 0.7, "growing"));
  const AirwayTree& tree = model.growth->result.tree;

  auto start = std::chrono::steady_clock::now();
  const MorphometryInput input{.lobes = *model.regions};
  const Morphometry whole = measure(tree, input, progress.part(0.7, 0.85, "measuring"));
  const auto byLobe = measureByLobe(tree, input, progress.part(0.85, 1.0, "measuring"));
  progress.report(1.0);
  const double measureSeconds = secondsSince(start);

  start = std::chrono::steady_clock::now();
  OutputSet outputs;
  outputs.add(common.output);
  std::map<std::string, std::string> metadata = treeMetadata(model);
  if (variation.any()) metadata["variation"] = toJson(variation).dump();
  writeTree(common.output, tree, metadata);
  if (!arguments.points.empty()) {
    outputs.add(arguments.points);
    writeFile(arguments.points, aggregateText(model.growth->result.aggregate, metadata),
              common.existing());
  }
  Json report = growthReport(model, whole, byLobe, measureSeconds, secondsSince(start));
  if (variation.any()) report["variation"] = toJson(variation);
  if (!arguments.report.empty()) {
    outputs.add(arguments.report);
    writeFile(arguments.report, jsonText(report), common.existing());
  }
  outputs.keep();

  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << summary(report, model.growth->efficiency, common.output.string());
  }
  return failedChecks(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareGrow(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<GrowArguments>();
  addGrowthArguments(app, *arguments);
  app.add_option_function<std::string>(
         "--points", [arguments](const std::string& text) { setPoints(*arguments, text); },
         "A number: fill the lobes with exactly this many points (centroid). A file (.vtp): write "
         "the raw aggregate with its order of arrival there (dla).")
      ->type_name("N|FILE");
  addShortcut(app, *arguments, "seed", "Seed of everything random.");
  addOutput(app, common, "FILE", "Where the tree goes: .vtp, .swc, .csv or .json.")->required();
  app.add_option("--report", arguments->report, "Write the JSON report here as well.")
      ->type_name("FILE");
  addJson(app, common);
  app.footer(growthOptionsHelp());
  return [arguments, &common](const Progress& progress) {
    return runGrow(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
