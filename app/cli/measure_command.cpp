#include <iostream>
#include <memory>

#include "anatomy/morphometry.h"
#include "anatomy/validation.h"
#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "geometry/surface_domain.h"
#include "io/tree_file.h"
#include "pipeline/efficiency_report.h"
#include "pipeline/measure_report.h"
#include "pipeline/organs.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

struct MeasureArguments {
  std::filesystem::path tree;
  std::vector<std::filesystem::path> domain;
  std::string organ;
  OrganOptions organOptions;
  std::uint64_t seed = 1;
  bool csv = false;

  static constexpr auto fields() {
    return std::tuple{Field{"seed", &MeasureArguments::seed, "", Range{0, 9007199254740991.0},
                            "Seed of the random points of the gap."}};
  }
};

/// The lobes as measured against, with the files they came from.
struct Regions {
  std::vector<LobeRegion> lobes;
  EfficiencyCubes cubes;
  std::vector<InputFile> inputs;
  std::vector<std::string> warnings;
};

Regions regionsOf(const MeasureArguments& arguments, const Progress& progress) {
  if (!arguments.organ.empty()) {
    const LungModel organ = openOrgan(arguments.organ, arguments.organOptions);
    return {*organ.regions, organ.cubes, {}, {}};
  }
  if (arguments.domain.empty()) return {};
  const LungModel model = openLobes(arguments.domain, progress);
  Regions regions{{}, model.cubes, model.inputs, model.warnings};
  for (const LobeSurface& surface : *model.surfaces) {
    if (!surface.health.fitToGrow()) {
      throw InvalidInput("'" + surface.name +
                         "' is not fit to measure in: " + complaints(surface.health).front());
    }
    regions.lobes.push_back({surface.lobe, std::make_shared<SurfaceDomain>(*surface.mesh)});
  }
  return regions;
}

Json atMostZero(const std::string& id, std::size_t value) {
  return {{"id", id}, {"value", value}, {"limit", 0}, {"ok", value == 0}};
}

struct Measured {
  Morphometry whole;
  std::map<Lobe, Morphometry> byLobe;
  std::optional<Efficiency> efficiency;  ///< where lobes are known
};

Json measureReport(const MeasureArguments& arguments, const TreeFile& file, const Regions& regions,
                   const Measured& measured) {
  std::vector<InputFile> inputs = {inputFile(arguments.tree)};
  inputs.insert(inputs.end(), regions.inputs.begin(), regions.inputs.end());
  Json parameters = Json::object();
  if (!arguments.organ.empty()) {
    parameters["organ"] = arguments.organ;
    parameters.update(toJson(arguments.organOptions));
  }
  Json report = reportEnvelope("pneuma/measure/1", inputs, parameters, arguments.seed);
  report["checks"].push_back(atMostZero("TREE-PROBLEMS", problems(file.tree).size()));
  if (!regions.lobes.empty()) {
    const Outside outside = outsideTheirLobe(file.tree, regions.lobes);
    report["outside"] = {{"ends", outside.ends}, {"segments", outside.segments}};
    report["checks"].push_back(atMostZero("OUTSIDE-ENDS", outside.ends));
  }
  for (const std::string& note : file.notes) report["warnings"].push_back(note);
  for (const std::string& warning : regions.warnings) report["warnings"].push_back(warning);
  report["branches"] = file.tree.size();
  report["terminals"] = terminalCount(file.tree);
  report["morphometry"] = toJson(measured.whole);
  if (measured.efficiency.has_value()) report["efficiency"] = toJson(*measured.efficiency);
  report["published"] = publishedJson(measured.whole);
  report["lobes"] = Json::object();
  for (const auto& [lobe, morphometry] : measured.byLobe) {
    report["lobes"][std::string(shortName(lobe))] = toJson(morphometry);
  }
  return report;
}

std::string textOf(const Measured& measured) {
  std::string text = measureText(measured.whole, measured.byLobe);
  if (measured.efficiency.has_value()) text += "\n" + efficiencyText(*measured.efficiency);
  return text;
}

ExitCode runMeasure(const MeasureArguments& arguments, const CommonOptions& common,
                    const Progress& progress) {
  if (arguments.csv && common.json) throw InvalidOption("measure takes --csv or --json, not both");
  if (!arguments.domain.empty() && !arguments.organ.empty()) {
    throw InvalidOption("measure takes --domain or --organ, not both");
  }
  if (arguments.organ.empty() && arguments.organOptions.sizeMl > 0.0) {
    throw InvalidOption("--organ-size is for a built-in organ; name one with --organ");
  }
  if (!common.output.empty()) requireOutput(common.output, common.existing());
  const TreeFile file = readTree(arguments.tree);
  const Regions regions = regionsOf(arguments, progress.part(0.0, 0.3, "reading"));
  const MorphometryInput input{.lobes = regions.lobes, .seed = arguments.seed};
  Measured measured{measure(file.tree, input, progress.part(0.3, 0.7, "measuring")),
                    measureByLobe(file.tree, input, progress.part(0.7, 0.95, "measuring")),
                    {}};
  if (!regions.lobes.empty()) {
    measured.efficiency =
        efficiency(file.tree, regions.lobes, regions.cubes, progress.part(0.95, 1.0, "measuring"));
  }
  progress.report(1.0);
  const Json report = measureReport(arguments, file, regions, measured);
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
  app.add_option("--domain", arguments->domain,
                 "The lobes' surfaces, or a folder of them: gives homogeneity and counts what "
                 "leaves its lobe.")
      ->type_name("FILE");
  app.add_option("--organ", arguments->organ, "A built-in organ instead of surfaces.")
      ->type_name(choiceType(organNames()));
  addFields(app, arguments->organOptions);
  addFields(app, *arguments);
  app.add_flag("--csv", arguments->csv, "Print the figures as CSV.");
  addJson(app, common);
  addOutput(app, common, "FILE", "Write the result here instead of standard output.");
  return [arguments, &common](const Progress& progress) {
    return runMeasure(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
