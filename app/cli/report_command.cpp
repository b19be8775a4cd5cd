#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/model_scene.h"
#include "cli/picture_arguments.h"
#include "cli/text.h"
#include "pipeline/case_page.h"
#include "pipeline/case_pdf.h"
#include "pipeline/case_report.h"
#include "render/picture.h"

namespace pneuma::cli {
namespace {

struct ReportArguments {
  std::vector<std::filesystem::path> inputs;
  CaseReportOptions options;
};

Project opened(const std::vector<std::filesystem::path>& inputs, const Progress& progress) {
  if (inputs.size() == 1 && isProjectFileName(inputs.front())) {
    return readProject(inputs.front(), progress);
  }
  Project project;
  project.state.name = inputs.front().filename().string();
  project.state.model = openFiles(inputs, progress);
  return project;
}

/// The lungs from four sides, on white as paper is.
std::vector<PagePicture> picturesOf(const LungModel& model, const Progress& progress) {
  if (!model.surfaces && !treeOf(model)) return {};
  Scene scene;
  SceneOptions options;
  options.background = Background::White;
  options.legend = false;
  scene.setOptions(options);
  showModel(scene, model);
  std::vector<PagePicture> pictures;
  for (const auto& [view, caption] : {std::pair{"anterior", "From the front"},
                                      {"left", "From the left"},
                                      {"posterior", "From behind"},
                                      {"right", "From the right"}}) {
    scene.look(viewDirection(view));
    pictures.push_back({caption, pngText(renderPicture(scene, 480, 480))});
    progress.report(static_cast<double>(pictures.size()) / 4.0);
  }
  return pictures;
}

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
  const std::filesystem::path kind = common.output.extension();
  if (kind != ".html" && kind != ".json" && kind != ".pdf") {
    throw Unsupported("reports are written as .html, .pdf and .json; '" + common.output.string() +
                      "' ends otherwise");
  }
  requireOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, arguments.inputs);
  if (kind != ".json") requireDisplay();
  const Project project = opened(arguments.inputs, progress.part(0.0, 0.3, "reading"));
  const Json report = caseReport(project, arguments.options, progress.part(0.3, 0.8, "measuring"));
  const auto pictures = [&] {
    return picturesOf(project.state.model, progress.part(0.8, 1.0, "drawing"));
  };
  const std::string text = kind == ".json"  ? jsonText(report)
                           : kind == ".pdf" ? casePdf(report, pictures())
                                            : casePage(report, pictures());
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
