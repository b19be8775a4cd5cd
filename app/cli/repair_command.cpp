#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/mesh_report.h"
#include "cli/text.h"
#include "core/error.h"
#include "geometry/repair.h"
#include "io/surface_file.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

Json repairReport(const std::filesystem::path& input, const std::filesystem::path& output,
                  const SurfaceFile& file, const Repaired& result) {
  const std::vector<InputFile> inputs = {inputFile(input)};
  Json report = reportEnvelope("pneuma/repair/1", inputs, Json::object(), 0);
  report["output"] = output.string();
  report["changes"] = result.changes;
  report["before"] = toJson(result.before);
  report["after"] = toJson(result.after);
  report["warnings"] = file.notes;
  for (const std::string& complaint : complaints(result.after)) {
    report["warnings"].push_back(complaint);
  }
  report["checks"].push_back({{"id", "HEALTHY"},
                              {"value", result.after.healthy()},
                              {"limit", true},
                              {"ok", result.after.healthy()}});
  return report;
}

std::string summary(const std::filesystem::path& output, const Repaired& result) {
  std::string text = output.string() + ": ";
  if (result.changes.empty()) return text + "nothing had to be changed\n";
  text += "\n";
  for (const std::string& change : result.changes) text += "  - " + change + "\n";
  return text + table({{"", "before", "after"},
                       {"triangles", grouped(static_cast<double>(result.before.triangles)),
                        grouped(static_cast<double>(result.after.triangles))},
                       {"volume", fixed(result.before.volumeMl, 1) + " ml",
                        fixed(result.after.volumeMl, 1) + " ml"}});
}

/// @throws InvalidInput naming the file if nothing is left of it
Repaired repairedFile(const std::filesystem::path& input, const TriangleMesh& mesh,
                      const Progress& progress) {
  try {
    return repaired(mesh, progress);
  } catch (const InvalidInput& error) {
    throw InvalidInput("'" + input.string() + "': " + error.what());
  }
}

ExitCode runRepair(const std::filesystem::path& input, const CommonOptions& common,
                   const Progress& progress) {
  requireSurfaceOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, {&input, 1});
  const SurfaceFile file = readSurface(input);
  const Repaired result = repairedFile(input, file.mesh, progress.part(0.0, 1.0, "mending"));
  progress.report(1.0);
  const Json report = repairReport(input, common.output, file, result);
  writeSurface(common.output, result.mesh);
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << summary(common.output, result) << failedChecks(report);
  }
  return result.after.healthy() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareRepair(CLI::App& app, CommonOptions& common) {
  const auto input = std::make_shared<std::filesystem::path>();
  app.add_option("SURFACE", *input, "The surface to mend: STL, OBJ, PLY or VTP.")
      ->type_name("FILE")
      ->required();
  addOutput(app, common, "FILE", "Where the mended surface goes: .stl, .ply, .obj or .vtp.")
      ->required();
  addJson(app, common);
  return [input, &common](const Progress& progress) { return runRepair(*input, common, progress); };
}

}  // namespace pneuma::cli
