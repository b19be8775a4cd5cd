#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/picture_arguments.h"
#include "cli/text.h"
#include "pipeline/case_document.h"
#include "pipeline/case_parts.h"
#include "pipeline/case_report.h"
#include "views/case_pictures.h"

namespace pneuma::cli {
namespace {

struct ReportArguments {
  std::vector<std::filesystem::path> inputs;
  CaseReportOptions options;
};

std::string failures(const Json& report) {
  std::string text;
  for (const Json& check : report.at("checks")) {
    if (check.at("ok").get<bool>()) continue;
    text += "check failed: " + check.at("of").get<std::string>() + ", " +
            check.at("id").get<std::string>() + " is " + check.at("value").dump() +
            ", the limit is " + check.at("high").dump() + "\n";
  }
  return text;
}

ExitCode runReport(const ReportArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  requireCaseDocumentName(common.output);
  requireOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, arguments.inputs);
  if (hasPictures(common.output)) requireDisplay();
  const Project project = openCase(arguments.inputs, progress.part(0.0, 0.3, "reading"));
  const Json report = caseReport(project, arguments.options, progress.part(0.3, 0.8, "measuring"));
  std::vector<PagePicture> pictures;
  if (hasPictures(common.output)) {
    pictures = casePictures(project.state.model, progress.part(0.8, 1.0, "drawing"));
  }
  const std::string text = caseDocument(common.output, report, pictures);
  OutputSet outputs;
  outputs.add(common.output);
  writeFile(common.output, text, common.existing());
  outputs.keep();
  if (!common.quiet) {
    printWarnings(project.notes);
    std::cout << common.output.string() << ": " << report.at("checks").size() << " checks\n"
              << failures(report);
  }
  return failures(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareReport(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<ReportArguments>();
  addFiles(app, "CASE", arguments->inputs,
           "A project (.pneuma), or surfaces and trees as 'pneuma render' takes them.")
      ->required();
  app.add_flag("--identify", arguments->options.identify,
               "Name the case and its files, which may tell whose lungs they are.");
  addOutput(app, common, "FILE", "The report: one page (.html, .pdf) or everything (.json).")
      ->required();
  return [arguments, &common](const Progress& progress) {
    return runReport(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
