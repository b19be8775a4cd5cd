#include <cctype>
#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"
#include "pipeline/lobe_shares.h"
#include "pipeline/report.h"
#include "pipeline/split_lobes.h"

namespace pneuma::cli {
namespace {

constexpr const char* ReportName = "lobes.json";
constexpr const char* PointsName = "fissures.json";
constexpr const char* PatchFolder = "fissures";

struct LobesArguments {
  std::vector<std::filesystem::path> lungs;
  std::filesystem::path fissures;
  std::string fractions;
  LobeOptions options;
};

std::string lobeFile(Lobe lobe) {
  std::string name(shortName(lobe));
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name + ".vtp";
}

/// The regions that a fissure lies between, below and above; the lower lobe has two neighbours.
TriangleMesh patchOf(const SplitLung& lung, Fissure fissure) {
  const auto contact = [&](Lobe behind, Lobe front) {
    return contactOf(lung.complex, static_cast<RegionId>(behind), static_cast<RegionId>(front));
  };
  switch (fissure) {
    case Fissure::RightHorizontal:
      return contact(Lobe::RightMiddle, Lobe::RightUpper);
    case Fissure::LeftOblique:
      return contact(Lobe::LeftLower, Lobe::LeftUpper);
    default:
      break;
  }
  TriangleMesh mesh = contact(Lobe::RightLower, Lobe::RightMiddle);
  const TriangleMesh other = contact(Lobe::RightLower, Lobe::RightUpper);
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + first, b + first, c + first});
  }
  return mesh;
}

std::filesystem::path patchPath(const std::filesystem::path& folder, Fissure fissure) {
  return folder / PatchFolder / (std::string(shortName(fissure)) + ".vtp");
}

std::vector<std::filesystem::path> outputsOf(const std::filesystem::path& folder,
                                             const LungModel& model, bool points) {
  std::vector<std::filesystem::path> outputs = {folder / ReportName};
  for (const LobeSurface& surface : *model.surfaces) {
    if (surface.lobe != Lobe::RightLung && surface.lobe != Lobe::LeftLung) continue;
    const Side of = side(surface.lobe);
    for (const Lobe lobe : lobesOf(of)) outputs.push_back(folder / lobeFile(lobe));
    for (const Fissure fissure : fissuresOf(of)) outputs.push_back(patchPath(folder, fissure));
  }
  if (points) outputs.push_back(folder / PointsName);
  return outputs;
}

void writeAll(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& paths,
              const LobesOfLungs& lobes, const LobeInputs& inputs, const Json& report,
              const Progress& progress) {
  OutputSet outputs;
  outputs.addFolder(folder);
  outputs.addFolder(folder / PatchFolder);
  for (const auto& path : paths) outputs.add(path);
  for (const SplitLung& lung : lobes.lungs) {
    for (const Lobe lobe : lobesOf(lung.side)) {
      writeSurface(folder / lobeFile(lobe),
                   surfaceOf(lung.complex, static_cast<RegionId>(lobe)).mesh);
      progress.throwIfStopped();
    }
    for (const Fissure fissure : fissuresOf(lung.side)) {
      writeSurface(patchPath(folder, fissure), patchOf(lung, fissure));
      progress.throwIfStopped();
    }
  }
  if (!inputs.given.empty()) writeFissures(folder / PointsName, inputs.given);
  writeFile(folder / ReportName, jsonText(report));
  outputs.keep();
}

ExitCode runLobes(const LobesArguments& arguments, const CommonOptions& common,
                  const Progress& progress) {
  LobeInputs inputs;
  inputs.shares = lobeSharesOfText(arguments.fractions);
  requireFolderOutput(common.output);
  if (!arguments.fissures.empty()) inputs.given = readFissures(arguments.fissures);
  LungModel model = openLobes(arguments.lungs, progress.part(0.0, 0.3, "reading surfaces"));
  if (!arguments.fissures.empty()) model.inputs.push_back(inputFile(arguments.fissures));
  const std::vector<std::filesystem::path> paths =
      outputsOf(common.output, model, !inputs.given.empty());
  for (const auto& path : paths) {
    std::error_code ignored;
    if (std::filesystem::exists(path.parent_path(), ignored)) {
      requireOutput(path, common.existing());
    }
    requireOtherThanInputs(path, arguments.lungs);
    requireOtherThanInputs(path, {&arguments.fissures, 1});
  }
  const LobesOfLungs lobes =
      splitLobes(model, inputs, arguments.options, progress.part(0.3, 0.9, "splitting lungs"));
  const Json report = lobesReport(model, lobes, arguments.options);
  writeAll(common.output, paths, lobes, inputs, report, progress.part(0.9, 1.0, "writing"));
  progress.report(1.0);
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << lobesText(lobes) << failedChecks(report);
  }
  return failedChecks(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareLobes(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<LobesArguments>();
  addFiles(
      app, "LUNGS", arguments->lungs,
      "Closed surfaces of whole lungs, named right and left, or a folder of them: what 'pneuma "
      "segment --surfaces' writes.")
      ->required();
  app.add_option("--fissures", arguments->fissures,
                 "Points upon the fissures, .json (pneuma/fissures/1) or .csv (Chest Imaging "
                 "Platform), LPS mm; a fissure without any is proposed by the lung's shape.")
      ->type_name("FILE");
  app.add_option("--fractions", arguments->fractions,
                 "Move the fissures until the lobes have these shares of their lung in percent, "
                 "RUL,RML,RLL[/LUL,LLL], or 'usual' for 40.5,12.9,46.6/50,50.")
      ->type_name("LIST");
  addFields(app, arguments->options);
  addOutput(app, common, "FOLDER",
            "The folder for rul.vtp, rml.vtp, rll.vtp, lul.vtp, lll.vtp, fissures/*.vtp and "
            "lobes.json: what 'pneuma grow' takes.")
      ->required();
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runLobes(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
