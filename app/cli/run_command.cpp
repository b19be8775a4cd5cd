#include <cmath>
#include <iostream>
#include <memory>
#include <utility>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "pipeline/report.h"
#include "pipeline/run_project.h"
#include "pipeline/run_recipe.h"

namespace pneuma::cli {
namespace {

struct RunArguments {
  std::filesystem::path recipe;
  std::filesystem::path ct;
  std::string from;
  std::string upTo;
  bool dryRun = false;
  bool packCt = false;
};

/// @throws InvalidOption naming the nearest stage
Stage stageOf(const std::string& text, const std::string& option) {
  const auto names = choices(Stage{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) return static_cast<Stage>(i);
  }
  const std::string_view nearest = nearestWord(text, {names.begin(), names.end()});
  throw InvalidOption(option + " names no stage with '" + text + "'" +
                      (nearest.empty() ? "; stages are " + joinedChoices(names)
                                       : "; did you mean '" + std::string(nearest) + "'?"));
}

/// Removes the folder again if the run made it and left nothing in it.
class MadeFolder {
 public:
  explicit MadeFolder(std::filesystem::path path)
      : path_(std::move(path)), was_(std::filesystem::exists(path_, ignored_)) {}

  ~MadeFolder() {
    if (!was_ && std::filesystem::is_empty(path_, ignored_)) {
      std::filesystem::remove(path_, ignored_);
    }
  }

  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  std::error_code ignored_;
  std::filesystem::path path_;
  bool was_;
};

Json reportOf(const Recipe& recipe, const std::vector<StageResult>& results) {
  Json report = reportEnvelope("pneuma/run-report/1", {}, toJson(recipe), 0);
  report["stages"] = Json::array();
  for (const StageResult& result : results) {
    report["stages"].push_back({{"stage", choices(Stage{})[static_cast<std::size_t>(result.stage)]},
                                {"state", textOf(result.state)},
                                {"seconds", result.seconds},
                                {"files", result.files},
                                {"warnings", result.warnings}});
    if (result.memoryBytes > 0) {
      report["stages"].back()["memory_mb"] =
          std::ceil(static_cast<double>(result.memoryBytes) / 1e6);
    }
    for (const std::string& warning : result.warnings) report["warnings"].push_back(warning);
  }
  return report;
}

/// Their names; of a folder's how many, as a line holds no more.
std::string listed(const std::vector<std::string>& files) {
  std::vector<std::pair<std::string, std::size_t>> parts;  // a file or folder, how many of it
  for (const std::string& file : files) {
    const std::size_t slash = file.find('/');
    const std::string part = slash == std::string::npos ? file : file.substr(0, slash + 1);
    if (parts.empty() || parts.back().first != part) parts.emplace_back(part, 0);
    ++parts.back().second;
  }
  std::string text;
  for (const auto& [part, count] : parts) {
    text += (text.empty() ? "" : ", ") + part;
    if (part.back() == '/') text += " (" + std::to_string(count) + " files)";
  }
  return text;
}

std::string tableOf(const std::vector<StageResult>& results) {
  std::vector<std::vector<std::string>> rows = {{"stage", "state", "time", "memory", "files"}};
  for (const StageResult& result : results) {
    rows.push_back({textOf(result.stage), textOf(result.state),
                    result.seconds > 0.0 ? fixed(result.seconds, 1) + " s" : "",
                    result.memoryBytes > 0
                        ? fixed(static_cast<double>(result.memoryBytes) / 1e6, 0) + " MB"
                        : "",
                    listed(result.files)});
  }
  return table(rows);
}

/// Everything into one project in place of a folder.
std::vector<StageResult> runIntoProject(const Recipe& recipe, const RunArguments& arguments,
                                        const RunOptions& options, const Progress& progress) {
  if (options.dryRun || options.anew) {
    throw InvalidOption(
        "a project is made in one go: --from and --dry-run need a folder as --output");
  }
  requireOutput(options.folder, options.existing);
  if (recipe.ct.empty()) throw InvalidInput("the recipe names no CT under \"open\": \"ct\"");
  requireOtherThanInputs(options.folder, {&recipe.ct, 1});
  std::vector<StageResult> results;
  Project project = projectOfRecipe(recipe, options.upTo, results, progress.part(0.0, 0.9, ""));
  if (arguments.packCt) project.ctStorage = CtStorage::Packed;
  writeProject(options.folder, project, progress.part(0.9, 1.0, "saving the project"));
  results.back().files.push_back(options.folder.filename().string());
  return results;
}

ExitCode report(const Recipe& recipe, const std::vector<StageResult>& results,
                const CommonOptions& common) {
  const Json report = reportOf(recipe, results);
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << tableOf(results);
  }
  return ExitCode::Done;
}

ExitCode runRun(const RunArguments& arguments, const CommonOptions& common,
                const Progress& progress) {
  if (arguments.recipe.empty() && arguments.ct.empty()) {
    throw InvalidOption("run needs a recipe, or a CT with --ct");
  }
  Recipe recipe;
  if (!arguments.recipe.empty()) recipe = readRecipe(arguments.recipe);
  if (!arguments.ct.empty()) recipe.ct = arguments.ct;
  std::error_code ignored;
  if (arguments.ct.empty() && !recipe.ct.empty() && !std::filesystem::exists(recipe.ct, ignored)) {
    throw InputMissing("there is no '" + recipe.ct.string() + "', which '" +
                       arguments.recipe.string() + "' names as the CT; check that path");
  }
  RunOptions options;
  options.folder = common.output;
  options.dryRun = arguments.dryRun;
  if (!arguments.upTo.empty()) options.upTo = stageOf(arguments.upTo, "--up-to");
  if (!arguments.from.empty()) {
    options.from = stageOf(arguments.from, "--from");
    options.anew = true;
  }
  options.existing = common.existing();
  if (isProjectFileName(options.folder)) {
    return report(recipe, runIntoProject(recipe, arguments, options, progress), common);
  }
  if (arguments.packCt) {
    throw InvalidOption("--pack-ct puts the CT into a project: end --output in .pneuma");
  }
  if (std::filesystem::exists(options.folder, ignored) &&
      !std::filesystem::is_directory(options.folder, ignored)) {
    throw OutputFailed("'" + options.folder.string() +
                       "' is a file; --output of run names a folder");
  }
  const MadeFolder folder(options.folder);
  return report(recipe, runRecipe(recipe, options, progress), common);
}

}  // namespace

Run declareRun(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<RunArguments>();
  app.add_option("RECIPE", arguments->recipe,
                 "What to do with the options of every stage, as JSON; without it the defaults.")
      ->type_name("FILE");
  app.add_option("--ct", arguments->ct, "The CT, instead of the recipe's.")->type_name("PATH");
  app.add_option(
         "-o,--output", common.output,
         "The folder for labels, surfaces, airways, tree and reports; or a project (.pneuma), "
         "which holds everything.")
      ->type_name("FOLDER|FILE")
      ->required();
  app.add_flag("-f,--force", common.force,
               "Replace files in the folder that no run left, or that were changed.");
  app.add_option("--from", arguments->from, "Do this stage and those after it anew.")
      ->type_name(choiceType(choices(Stage{})));
  app.add_option("--up-to", arguments->upTo, "Stop after this stage.")
      ->type_name(choiceType(choices(Stage{})));
  app.add_flag("--dry-run", arguments->dryRun, "Only say which stages would be done.");
  app.add_flag("--pack-ct", arguments->packCt,
               "Put the CT into the project too; without it the project has a link to it.");
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runRun(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
