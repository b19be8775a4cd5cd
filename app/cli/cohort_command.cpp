#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "pipeline/cohort_folder.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

struct CohortArguments {
  std::string action;
  std::filesystem::path folder;
  CohortSource source;
};

/// One word of a POSIX shell, as people would write it.
std::string shellWord(const std::string& text) {
  const std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+,=:@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  return shellQuoted(text);
}

/// This program, by its whole path: the jobs of a cluster may have another PATH.
std::string programWord() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::string("pneuma") : shellWord(self.string());
}

std::string commandAgain(const CohortArguments& arguments) {
  const auto word = [](const std::filesystem::path& path) {
    return shellWord(std::filesystem::absolute(path).lexically_normal().string());
  };
  std::string command = programWord() + " cohort init " + word(arguments.folder) + " --cases " +
                        word(arguments.source.cases);
  if (!arguments.source.recipe.empty()) command += " --recipe " + word(arguments.source.recipe);
  if (arguments.source.namesOfFolders) command += " --names";
  return command + " --force";
}

std::string methodsText(const std::vector<std::string>& methods) {
  std::string text;
  for (const std::string& method : methods) text += (text.empty() ? "" : ", ") + method;
  return text;
}

ExitCode runCohort(const CohortArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  if (arguments.action != "init") {
    throw InvalidOption("cohort has one action, init; '" + arguments.action + "' was given");
  }
  CohortWorkflow workflow;
  workflow.cohort = readCohort(arguments.source, progress.part(0.0, 0.9, "looking at the cases"));
  workflow.program = programWord();
  workflow.again = commandAgain(arguments);
  const WrittenCohort written = writeCohort(arguments.folder, workflow, common.existing());
  progress.report(1.0);
  if (!common.quiet) printWarnings(workflow.cohort.notes);
  if (common.json) {
    Json report = reportEnvelope("pneuma/cohort-report/1", {}, Json::object(), 0);
    report["warnings"] = workflow.cohort.notes;
    report["cases"] = workflow.cohort.cases.size();
    report["methods"] = workflow.cohort.methods;
    report["files"] = written.files;
    report["kept"] = written.kept;
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << arguments.folder.string() << ": workflow for "
              << grouped(static_cast<double>(workflow.cohort.cases.size())) << " case"
              << (workflow.cohort.cases.size() == 1 ? "" : "s") << ", trees by "
              << methodsText(workflow.cohort.methods) << "\n";
    for (const std::string& file : written.kept) {
      std::cout << "kept as it was: " << file << "\n";
    }
    std::cout << "Start it with:\n  cd " << shellWord(arguments.folder.string())
              << " && snakemake --profile profiles/local\n";
  }
  return ExitCode::Done;
}

}  // namespace

Run declareCohort(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<CohortArguments>();
  app.add_option(
         "ACTION", arguments->action,
         "init: write a Snakemake workflow. Snakemake then runs it, on this machine or on a "
         "cluster.")
      ->type_name("{init}")
      ->required();
  app.add_option("FOLDER", arguments->folder,
                 "Where the workflow goes, and the results after it; made if it is not there.")
      ->type_name("FOLDER")
      ->required();
  app.add_option(
         "--cases", arguments->source.cases,
         "The cases: a table (.csv) with a column ct, and case, series, fissures, recipe if "
         "wanted; or a folder of CTs.")
      ->type_name("FILE|FOLDER")
      ->required();
  app.add_option("--recipe", arguments->source.recipe,
                 "Options of all stages, as 'pneuma run' takes them, for cases without a recipe of "
                 "their own.")
      ->type_name("FILE");
  app.add_flag("--names", arguments->source.namesOfFolders,
               "Name the cases of a folder as its entries are named, which may tell who they are; "
               "else case-001 and so on.");
  app.add_flag("-f,--force", common.force,
               "Write the workflow anew; results, config.yaml and profiles stay as they are.");
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runCohort(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
