#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/progress.h"

namespace CLI {
class App;
}

namespace pneuma::cli {

struct CommonOptions;

/// Does a command's work with the arguments that were parsed for it. Results go to standard output,
/// everything else to standard error.
using Run = std::function<ExitCode(const Progress& progress)>;

/// One row of the table of commands.
struct Command {
  std::string_view name;
  std::string_view summary;
  /// Adds the command's own arguments to `app` and returns what to run once they are parsed.
  /// `common` outlives both.
  Run (*declare)(CLI::App& app, CommonOptions& common);
};

/// Every command, in the order of `pneuma help`.
std::span<const Command> commands();

/// @throws InvalidOption if there is no such command (the nearest is suggested)
const Command& command(std::string_view name);

Run declareAnonymize(CLI::App& app, CommonOptions& common);
Run declareCohort(CLI::App& app, CommonOptions& common);
Run declareCompare(CLI::App& app, CommonOptions& common);
Run declareCompletion(CLI::App& app, CommonOptions& common);
Run declareDoctor(CLI::App& app, CommonOptions& common);
Run declareEstimate(CLI::App& app, CommonOptions& common);
Run declareExport(CLI::App& app, CommonOptions& common);
Run declareFissures(CLI::App& app, CommonOptions& common);
Run declareBreathe(CLI::App& app, CommonOptions& common);
Run declareGrow(CLI::App& app, CommonOptions& common);
Run declareHelp(CLI::App& app, CommonOptions& common);
Run declareImport(CLI::App& app, CommonOptions& common);
Run declareInfo(CLI::App& app, CommonOptions& common);
Run declareLobes(CLI::App& app, CommonOptions& common);
Run declareCheck(CLI::App& app, CommonOptions& common);
Run declareMeasure(CLI::App& app, CommonOptions& common);
Run declareRegress(CLI::App& app, CommonOptions& common);
Run declareRender(CLI::App& app, CommonOptions& common);
Run declareRepair(CLI::App& app, CommonOptions& common);
Run declareReport(CLI::App& app, CommonOptions& common);
Run declareReproduce(CLI::App& app, CommonOptions& common);
Run declareRun(CLI::App& app, CommonOptions& common);
Run declareSample(CLI::App& app, CommonOptions& common);
Run declareSegment(CLI::App& app, CommonOptions& common);
Run declareStudy(CLI::App& app, CommonOptions& common);
Run declareThumbnail(CLI::App& app, CommonOptions& common);
Run declareOutline(CLI::App& app, CommonOptions& common);
Run declareVersion(CLI::App& app, CommonOptions& common);

}  // namespace pneuma::cli
