#include <iostream>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/text.h"
#include "pipeline/report.h"

namespace pneuma::cli {

Run declareVersion(CLI::App& app, CommonOptions& common) {
  addJson(app, common);
  return [&common](const Progress&) {
    if (common.json) {
      std::cout << jsonText({{"schema", "pneuma/version/1"},
                             {"name", "pneuma"},
                             {"version", versionText()},
                             {"commit", commitText()}});
    } else {
      std::cout << "pneuma " << versionText() << " (" << commitText() << ")\n";
    }
    return ExitCode::Done;
  };
}

}  // namespace pneuma::cli
