#include <chrono>
#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/tree_file.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

struct GrowArguments {
  std::vector<std::filesystem::path> lobes;
  std::string organ;
  std::filesystem::path central;
  std::string method{growthMethods().front().name};
  std::vector<std::string> assignments;
  std::vector<std::string> shortcuts;  ///< options of their own name, as assignments
  std::filesystem::path report;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

GrowthOptions growthOptions(const GrowArguments& arguments) {
  GrowthOptions options = growthMethod(arguments.method).defaults;
  std::visit(
      [&](auto& chosen) {
        for (const std::string& text : arguments.assignments) setFromAssignment(chosen, text);
        for (const std::string& text : arguments.shortcuts) setFromAssignment(chosen, text);
        requireValid(chosen);
      },
      options);
  return options;
}

void requireUsable(const GrowArguments& arguments, const CommonOptions& common) {
  if (arguments.lobes.empty() == arguments.organ.empty()) {
    throw InvalidOption(arguments.lobes.empty()
                            ? "grow needs lobe surfaces, a folder of them, or --organ NAME"
                            : "grow takes lobe surfaces or --organ, not both");
  }
  requireTreeOutput(common.output, common.existing());
  if (arguments.report.empty()) return;
  requireOutput(arguments.report, common.existing());
  if (arguments.report == common.output) {
    throw InvalidOption("--report and --output name the same file '" + common.output.string() +
                        "'");
  }
}

LungModel opened(const GrowArguments& arguments, const Progress& progress) {
  LungModel model = arguments.organ.empty()
                        ? openLobes(arguments.lobes, progress.part(0.0, 0.3, "reading"))
                        : openOrgan(arguments.organ);
  return arguments.central.empty() ? model : withCentral(model, arguments.central);
}

/// The report's figures for people.
std::string summary(const Json& report, const std::string& output) {
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
  const LungModel model =
      grow(opened(arguments, progress), options, progress.part(0.3, 0.7, "growing"));
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
  writeTree(common.output, tree, treeMetadata(model));
  const Json report = growthReport(model, whole, byLobe, measureSeconds, secondsSince(start));
  if (!arguments.report.empty()) {
    outputs.add(arguments.report);
    writeFile(arguments.report, jsonText(report), common.existing());
  }
  outputs.keep();

  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << summary(report, common.output.string());
  }
  return failedChecks(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

/// `--terminals N` and its like: the method's own options under names of their own.
void addShortcut(CLI::App& app, GrowArguments& arguments, const std::string& name,
                 const std::string& help) {
  app.add_option_function<std::string>(
         "--" + name,
         [&arguments, name](const std::string& text) {
           arguments.shortcuts.push_back(name + "=" + text);
         },
         help)
      ->type_name("N");
}

std::string methodsHelp() {
  std::string text;
  for (const GrowthMethod& method : growthMethods()) {
    text += "Options of --method " + std::string(method.name) + " (" + std::string(method.title) +
            "; " + std::string(method.citation) + "), for --set:\n" +
            std::visit([](const auto& options) { return fieldsHelp(options); }, method.defaults);
  }
  return text;
}

}  // namespace

Run declareGrow(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<GrowArguments>();
  addFiles(app, "LOBES", arguments->lobes,
           "Closed surfaces whose names carry rul, rml, rll, lul, lll; a folder of them; or one "
           "surface of any name.");
  app.add_option("--organ", arguments->organ, "A built-in organ instead of surfaces.")
      ->type_name(choiceType(organNames()));
  app.add_option("--central", arguments->central,
                 "Central airways (VTP, VTU, SWC, CSV, JSON); without it a template is used.")
      ->type_name("FILE");
  std::vector<std::string_view> methods;
  for (const GrowthMethod& method : growthMethods()) methods.push_back(method.name);
  app.add_option("--method", arguments->method, "How to grow.")
      ->type_name(choiceType(methods))
      ->default_str(arguments->method);
  addRepeatable(app, "--set", arguments->assignments, "KEY=VALUE",
                "Set an option of the method (list below). May be repeated.");
  addShortcut(app, *arguments, "terminals", "Aim at about this many terminals.");
  addShortcut(app, *arguments, "points", "Fill the lobes with exactly this many points.");
  addShortcut(app, *arguments, "seed", "Seed of everything random.");
  addOutput(app, common, "FILE", "Where the tree goes: .vtp, .swc, .csv or .json.")->required();
  app.add_option("--report", arguments->report, "Write the JSON report here as well.")
      ->type_name("FILE");
  addJson(app, common);
  app.footer(methodsHelp());
  return [arguments, &common](const Progress& progress) {
    return runGrow(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
