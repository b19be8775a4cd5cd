#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/text.h"
#include "pipeline/lobe_checks.h"
#include "pipeline/report.h"

namespace pneuma::cli {

Run declareCheck(CLI::App& app, CommonOptions& common) {
  const auto folder = std::make_shared<std::filesystem::path>();
  app.add_option("FOLDER", *folder,
                 "A folder of lobes: what 'pneuma lobes' writes, or surfaces named rul, rml, rll, "
                 "lul, lll.")
      ->type_name("FOLDER")
      ->required();
  addJson(app, common);
  return [folder, &common](const Progress& progress) {
    const LobeFolder found = checkLobes(*folder, progress);
    const Json report = checkReport(found);
    if (!common.quiet) printWarnings(found.warnings);
    if (common.json) {
      std::cout << jsonText(report);
    } else if (!common.quiet) {
      std::cout << checkText(found) << failedChecks(report);
    }
    return failedChecks(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
  };
}

}  // namespace pneuma::cli
