#include <charconv>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/growth_arguments.h"
#include "cli/text.h"
#include "pipeline/study.h"

namespace pneuma::cli {
namespace {

constexpr std::uint64_t LargestSeed = 9007199254740991;  // the largest that JSON keeps exactly

struct StudyArguments : GrowthArguments {
  std::string seeds = "20";
};

[[noreturn]] void throwNoSeeds(const std::string& text) {
  throw InvalidOption(
      "--seeds takes a number of seeds (20) or a range (1..20), 1 to 10000 of them, but '" + text +
      "' was given");
}

std::uint64_t seedNumber(std::string_view part, const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
  if (error != std::errc() || end != part.data() + part.size() || number > LargestSeed) {
    throwNoSeeds(text);
  }
  return number;
}

/// "20" is 1 .. 20. @throws InvalidOption
std::vector<std::uint64_t> seedsOf(const std::string& text) {
  const std::size_t dots = text.find("..");
  const bool range = dots != std::string::npos;
  const std::uint64_t first = range ? seedNumber(std::string_view(text).substr(0, dots), text) : 1;
  const std::uint64_t last =
      seedNumber(range ? std::string_view(text).substr(dots + 2) : std::string_view(text), text);
  if (last < first || last - first >= 10000) throwNoSeeds(text);
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = first; seed <= last; ++seed) seeds.push_back(seed);
  return seeds;
}

ExitCode runStudy(const StudyArguments& arguments, const CommonOptions& common,
                  const Progress& progress) {
  requireOneOrgan(arguments, "study");
  if (!common.output.empty()) {
    requireOutput(common.output, common.existing());
    if (common.output.extension() != ".csv") {
      throw Unsupported("a study is written as a table; '" + common.output.string() +
                        "' should end in .csv");
    }
  }
  const std::vector<std::uint64_t> seeds = seedsOf(arguments.seeds);
  const GrowthOptions options = growthOptions(arguments);
  const VariationOptions variation = variationOptions(arguments);
  const LungModel model = opened(arguments, progress.part(0.0, 0.05, "reading"));
  const Study result = study(model, options, variation, seeds, progress.part(0.05, 1.0, "growing"));
  progress.report(1.0);
  if (!common.output.empty()) writeFile(common.output, studyCsv(result), common.existing());
  const Json report = toJson(result, model);
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet || common.output.empty()) {
    std::cout << studyText(result);
  }
  return ExitCode::Done;
}

}  // namespace

Run declareStudy(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<StudyArguments>();
  addGrowthArguments(app, *arguments);
  addShortcut(app, *arguments, "points", "Fill the lobes with exactly this many points.");
  app.add_option("--seeds", arguments->seeds,
                 "How many individuals, with seeds from 1, or a range of seeds such as 5..24.")
      ->type_name("N")
      ->default_str(arguments->seeds);
  addOutput(app, common, "FILE", "Write the figures of every seed here as well, as .csv.");
  addJson(app, common);
  app.footer(growthOptionsHelp());
  return [arguments, &common](const Progress& progress) {
    return runStudy(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
