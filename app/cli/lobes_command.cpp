#include <cctype>
#include <iostream>
#include <memory>
#include <sstream>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"
#include "pipeline/report.h"
#include "pipeline/split_lobes.h"

namespace pneuma::cli {
namespace {

constexpr const char* ReportName = "lobes.json";
constexpr const char* PointsName = "fissures.json";
constexpr const char* PatchFolder = "fissures";
constexpr const char* PartFolder = "accessory";

struct LobesArguments {
  std::vector<std::filesystem::path> lungs;
  std::filesystem::path fissures;
  std::filesystem::path planes;
  std::string fractions;
  LobeOptions options;
};

LobeShares sharesOf(const std::string& text, std::size_t count) {
  LobeShares shares;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    try {
      std::size_t used = 0;
      shares.push_back(std::stod(part, &used) / 100.0);
      if (used != part.size()) shares.clear();
    } catch (const std::exception&) {
      shares.clear();
    }
    if (shares.empty()) break;
  }
  if (shares.size() == count) return shares;
  throw InvalidOption("--fractions takes RUL,RML,RLL or RUL,RML,RLL/LUL,LLL in percent, not '" +
                      text + "'");
}

/// "40.5,12.9,46.6/50,50"; "usual" for what most people have.
std::map<Side, LobeShares> fractionsOf(const std::string& text) {
  if (text.empty()) return {};
  if (text == "usual") {
    return {{Side::Right, usualShares(Side::Right)}, {Side::Left, usualShares(Side::Left)}};
  }
  const std::size_t slash = text.find('/');
  std::map<Side, LobeShares> shares;
  shares[Side::Right] = sharesOf(text.substr(0, slash), 3);
  if (slash != std::string::npos) shares[Side::Left] = sharesOf(text.substr(slash + 1), 2);
  return shares;
}

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
  if (!lobes.parted.empty()) outputs.addFolder(folder / PartFolder);
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
  writePartedLobes(folder, lobes.parted);
  if (!inputs.given.empty() || !inputs.accessory.empty()) {
    writeFissures(folder / PointsName, inputs.given, inputs.accessory);
  }
  writeFile(folder / ReportName, jsonText(report));
  outputs.keep();
}

ExitCode runLobes(const LobesArguments& arguments, const CommonOptions& common,
                  const Progress& progress) {
  LobeInputs inputs;
  inputs.shares = fractionsOf(arguments.fractions);
  requireFolderOutput(common.output);
  const std::filesystem::path& given =
      arguments.planes.empty() ? arguments.fissures : arguments.planes;
  FissureFile file;
  if (!arguments.fissures.empty()) file = readFissureFile(given);
  if (!arguments.planes.empty()) file.fissures = readPlanes(given);
  inputs.given = file.fissures;
  inputs.accessory = file.accessory;
  LungModel model = openLobes(arguments.lungs, progress.part(0.0, 0.3, "reading surfaces"));
  std::vector<std::filesystem::path> givenFiles = patchFiles(file);
  if (!given.empty()) givenFiles.push_back(given);
  for (const auto& path : givenFiles) model.inputs.push_back(inputFile(path));
  std::vector<std::filesystem::path> paths = outputsOf(common.output, model, !given.empty());
  for (const auto& part : partedLobeFiles(inputs.accessory)) paths.push_back(common.output / part);
  for (const auto& path : paths) {
    std::error_code ignored;
    if (std::filesystem::exists(path.parent_path(), ignored)) {
      requireOutput(path, common.existing());
    }
    requireOtherThanInputs(path, arguments.lungs);
    requireOtherThanInputs(path, givenFiles);
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
  CLI::Option* fissures =
      app.add_option(
             "--fissures", arguments->fissures,
             "The fissures: points, planes, equations or surfaces in .json (pneuma/fissures/1), "
             "points in .mrk.json or .fcsv (3D Slicer) or .csv (Chest Imaging Platform); "
             "one that is not there is proposed by the lung's shape.")
          ->type_name("FILE");
  app.add_option("--planes", arguments->planes,
                 "The same from a .json file that has planes and nothing else.")
      ->type_name("FILE")
      ->excludes(fissures);
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
