#include <algorithm>
#include <cctype>
#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "core/units.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "pipeline/report.h"
#include "pipeline/sample_chest.h"

namespace pneuma::cli {
namespace {

enum class SurfaceFormat { Stl, Ply, Obj, Vtp };

constexpr std::array<std::string_view, 4> choices(SurfaceFormat) {
  return {"stl", "ply", "obj", "vtp"};
}

struct SampleArguments {
  std::filesystem::path folder;
  double cellMm = 2.0;
  SurfaceFormat format = SurfaceFormat::Stl;

  static constexpr auto fields() {
    using S = SampleArguments;
    return std::tuple{
        Field{"cell", &S::cellMm, "mm", Range{0.5, 6.0},
              "Side of the lattice the surfaces are made on."},
        Field{"format", &S::format, "", Range{}, "Format of the surfaces."},
    };
  }
};

constexpr std::string_view CentralName = "central.vtp";
constexpr std::string_view TruthName = "truth.json";

std::string surfaceName(Lobe lobe, SurfaceFormat format) {
  std::string name(shortName(lobe));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name + "." + textOf(format);
}

void requireUsable(const SampleArguments& arguments, const CommonOptions& common) {
  std::error_code error;
  if (!std::filesystem::exists(arguments.folder, error)) {
    requireOutput(arguments.folder, common.existing());  // the folder itself can be made
    return;
  }
  for (const Lobe lobe : FiveLobes) {
    requireOutput(arguments.folder / surfaceName(lobe, arguments.format), common.existing());
  }
  requireOutput(arguments.folder / CentralName, common.existing());
  requireOutput(arguments.folder / TruthName, common.existing());
}

/// What is known about the chest without measuring its files.
Json truth(const SampleChest& chest, const SampleArguments& arguments) {
  Json parameters = {{"cell_mm", arguments.cellMm}};
  Json report = reportEnvelope("pneuma/sample/1", {}, parameters, 0);
  report["central"] = CentralName;
  report["lobes"] = Json::object();
  for (std::size_t i = 0; i < chest.lobes.size(); ++i) {
    const LobeSurface& surface = chest.lobes[i];
    report["lobes"][std::string(shortName(surface.lobe))] = {
        {"file", surfaceName(surface.lobe, arguments.format)},
        {"volume_ml", millilitres(chest.truth[i].domain->volumeMm3())},
        {"surface_volume_ml", millilitres(signedVolumeMm3(*surface.mesh))},
        {"triangles", surface.mesh->triangles.size()}};
  }
  report["fissures"] = Json::array();
  for (const SampleFissure& fissure : chest.fissures) {
    report["fissures"].push_back(
        {{"name", fissure.name},
         {"equation", "z = height + slope y + bend y^2 + side_bend (x - side)^2"},
         {"height_mm", fissure.heightMm},
         {"slope", fissure.slope},
         {"bend_per_mm", fissure.bend},
         {"side_bend_per_mm", fissure.sideBend},
         {"side_mm", fissure.sideMm}});
  }
  return report;
}

ExitCode runSample(const SampleArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  requireUsable(arguments, common);
  const SampleChest chest =
      sampleChest(arguments.cellMm, progress.part(0.0, 1.0, "making a chest"));
  progress.report(1.0);
  const Json report = truth(chest, arguments);

  OutputSet outputs;
  outputs.addFolder(arguments.folder);
  for (const LobeSurface& surface : chest.lobes) {
    const auto path = arguments.folder / surfaceName(surface.lobe, arguments.format);
    outputs.add(path);
    writeSurface(path, *surface.mesh);
    progress.throwIfStopped();
  }
  outputs.add(arguments.folder / CentralName);
  writeTree(arguments.folder / CentralName, chest.central,
            {{"method", "sample"}, {"version", versionText()}});
  outputs.add(arguments.folder / TruthName);
  writeFile(arguments.folder / TruthName, jsonText(report), common.existing());
  outputs.keep();

  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::vector<std::vector<std::string>> rows = {{"lobe", "file", "true volume", "of surface"}};
    for (const auto& [name, lobe] : report.at("lobes").items()) {
      rows.push_back({name, lobe.at("file").get<std::string>(),
                      fixed(lobe.at("volume_ml").get<double>(), 1) + " ml",
                      fixed(lobe.at("surface_volume_ml").get<double>(), 1) + " ml"});
    }
    std::cout << arguments.folder.string() << ": five lobes, " << CentralName << ", " << TruthName
              << "\n"
              << table(rows);
  }
  return ExitCode::Done;
}

}  // namespace

Run declareSample(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<SampleArguments>();
  app.add_option("FOLDER", arguments->folder, "Where the files go; made if it is not there.")
      ->type_name("FOLDER")
      ->required();
  addFields(app, *arguments);
  addForce(app, common);
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runSample(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
