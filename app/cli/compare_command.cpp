#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/comparison_picture.h"
#include "cli/files.h"
#include "cli/region_arguments.h"
#include "cli/text.h"
#include "pipeline/compare_shapes.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

struct CompareArguments : RegionArguments {
  std::vector<std::filesystem::path> trees;
  bool csv = false;
  std::filesystem::path picture;
  PictureArguments look{.size = {700, 700}};
  ShapeLimits limits;
};

/// Two label images or two surfaces.
ExitCode runShapes(const CompareArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  if (arguments.csv || !arguments.picture.empty()) {
    throw InvalidOption(
        "--csv and --picture are for trees; for labels and surfaces there is --json");
  }
  if (!common.output.empty()) requireOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, arguments.trees);
  const ShapeComparison comparison =
      compareShapes(arguments.trees[0], arguments.trees[1], arguments.limits,
                    progress.part(0.0, 0.9, "comparing"));
  std::vector<InputFile> inputs;
  if (common.json) {
    inputs = {inputFile(arguments.trees[0], progress.part(0.9, 0.95, "hashing")),
              inputFile(arguments.trees[1], progress.part(0.95, 1.0, "hashing"))};
  }
  progress.report(1.0);
  const std::string text = common.json ? jsonText(toJson(comparison, inputs)) : textOf(comparison);
  if (common.output.empty()) {
    std::cout << text;
  } else {
    writeFile(common.output, text, common.existing());
  }
  for (const std::string& failure : comparison.failures) {
    std::cerr << "pneuma: over its limit: " << failure << "\n";
  }
  return comparison.failures.empty() ? ExitCode::Done : ExitCode::ComparisonOverLimit;
}

void requireUsable(const CompareArguments& arguments, const CommonOptions& common) {
  if (arguments.csv && common.json) throw InvalidOption("compare takes --csv or --json, not both");
  requireOneRegion(arguments, "compare");
  (void)viewDirection(arguments.look.view);
  if (!common.output.empty()) requireOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, arguments.trees);
  if (arguments.picture.empty()) return;
  requirePngOutput(arguments.picture, common.existing());
  if (arguments.picture == common.output) {
    throw InvalidOption("--picture and --output name the same file '" + common.output.string() +
                        "'");
  }
  requireDisplay();
}

ExitCode runCompare(const CompareArguments& arguments, const CommonOptions& common,
                    const Progress& progress) {
  if (arguments.trees.size() == 2 && areShapes(arguments.trees[0], arguments.trees[1])) {
    return runShapes(arguments, common, progress);
  }
  if (arguments.limits != ShapeLimits{}) {
    throw InvalidOption("limits such as --min-dice are for two label images or two surfaces");
  }
  requireUsable(arguments, common);
  const bool draw = !arguments.picture.empty();
  std::vector<OpenedTree> trees =
      openTrees(arguments.trees, progress.part(0.0, 0.1, "reading trees"));
  const LungModel organ = opened(arguments, progress.part(0.1, 0.3, "reading surfaces"));
  const TreeComparison comparison = compareTrees(std::move(trees), organ, arguments.seed,
                                                 progress.part(0.3, draw ? 0.9 : 1.0, "measuring"));
  Picture picture;
  if (draw) {
    picture = comparisonPicture(comparison, organ, arguments.look,
                                progress.part(0.9, 1.0, "drawing the trees"));
  }
  progress.report(1.0);
  const Json report = toJson(comparison, organ, parametersOf(arguments));
  const std::string text = common.json     ? jsonText(report)
                           : arguments.csv ? compareCsv(comparison)
                                           : compareText(comparison);
  OutputSet outputs;
  if (draw) {
    outputs.add(arguments.picture);
    writeFile(arguments.picture, pngText(picture), common.existing());
  }
  if (!common.output.empty()) {
    outputs.add(common.output);
    writeFile(common.output, text, common.existing());
  }
  outputs.keep();
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.output.empty()) std::cout << text;
  const std::string failed = failedChecks(report);
  std::cerr << failed;
  return failed.empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareCompare(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<CompareArguments>();
  addFiles(app, "FILES", arguments->trees,
           "Two trees or more: VTP, VTU, SWC, CSV or JSON; or two label images; or two surfaces.")
      ->required()
      ->expected(2, CLI::detail::expected_max_vector_size);
  addRegionArguments(app, *arguments);
  addFields(app, arguments->limits);
  app.add_flag("--csv", arguments->csv, "Print the figures as CSV.");
  addJson(app, common);
  addOutput(app, common, "FILE", "Write the result here instead of standard output.");
  CLI::Option* picture =
      app.add_option("--picture", arguments->picture,
                     "Draw the trees beside each other at the same scale, in the lobes if they are "
                     "given: .png.")
          ->type_name("FILE");
  for (CLI::Option* option : addPictureArguments(
           app, arguments->look, "Width and height of each tree's picture in pixels.")) {
    option->needs(picture);
  }
  return [arguments, &common](const Progress& progress) {
    return runCompare(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
