#include <algorithm>
#include <cctype>
#include <iostream>
#include <memory>
#include <optional>
#include <span>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "core/units.h"
#include "io/dicom_writer.h"
#include "io/fissure_file.h"
#include "io/json.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/report.h"
#include "pipeline/sample_chest.h"
#include "pipeline/sample_ct.h"

namespace pneuma::cli {
namespace {

enum class SurfaceFormat { Stl, Ply, Obj, Vtp };

constexpr std::array<std::string_view, 4> choices(SurfaceFormat) {
  return {"stl", "ply", "obj", "vtp"};
}

struct SampleArguments {
  std::filesystem::path folder;
  bool ct = false;
  SampleCtOptions ctOptions;
  std::vector<const CLI::Option*> ctFlags;  ///< that mean nothing without --ct
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
constexpr std::string_view FissuresName = "fissures.json";
constexpr std::string_view TruthName = "truth.json";
constexpr std::string_view CtName = "ct.nii.gz";
constexpr std::string_view LabelsName = "labels.nii.gz";
constexpr std::string_view DicomName = "dicom";

std::string surfaceName(Lobe lobe, SurfaceFormat format) {
  std::string name(shortName(lobe));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name + "." + pneuma::textOf(format);
}

void requireNotWithoutCt(const SampleArguments& arguments) {
  if (arguments.ct) return;
  for (const CLI::Option* option : arguments.ctFlags) {
    if (option->count() > 0) {
      throw InvalidOption(option->get_name() + " is about the CT of the sample; add --ct");
    }
  }
}

/// A series must not mix with slices that are there and would not be replaced.
/// @param names of the series' files; empty if they are not known yet
void requireNoOtherSlices(const std::filesystem::path& folder, std::span<const std::string> names,
                          Existing existing) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".dcm") continue;
    const std::string name = entry.path().filename().string();
    if (existing == Existing::Refuse) {
      throw OutputFailed("'" + entry.path().string() +
                         "' exists already; add --force to replace it, or choose another folder");
    }
    if (!names.empty() && std::ranges::find(names, name) == names.end()) {
      throw OutputFailed("'" + entry.path().string() +
                         "' would mix with the new series; remove it or choose another folder");
    }
  }
  if (error) {
    throw OutputFailed("'" + folder.string() + "' cannot be used as a folder: " + error.message());
  }
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
  requireOutput(arguments.folder / FissuresName, common.existing());
  requireOutput(arguments.folder / TruthName, common.existing());
  if (!arguments.ct) return;
  requireOutput(arguments.folder / CtName, common.existing());
  requireOutput(arguments.folder / LabelsName, common.existing());
  requireNoOtherSlices(arguments.folder / DicomName, {}, common.existing());
}

Json pointJson(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// What is known about the CT without looking at it.
Json ctTruth(const SampleCt& ct, const SampleCtOptions& options) {
  const ImageGeometry& geometry = ct.image.geometry;
  Json missing = Json::array();
  for (const int k : ct.missing) {
    missing.push_back(
        {{"slice", k},
         {"position_mm", pointJson(geometry.worldFromVoxel({0.0, 0.0, static_cast<double>(k)}))}});
  }
  return {{"volume", CtName},
          {"labels", LabelsName},
          {"dicom", DicomName},
          {"options", toJson(options)},
          {"size", geometry.size},
          {"spacing_mm", pointJson(geometry.spacing)},
          {"origin_mm", pointJson(geometry.origin)},
          {"missing_slices", missing},
          {"label_volume_ml",
           {{"right", labelMl(ct.truth, Lobe::RightLung)},
            {"left", labelMl(ct.truth, Lobe::LeftLung)},
            {"airways", labelMl(ct.truth, Lobe::Central)}}},
          {"airways_drawn", ct.airways.size()},
          {"carina_mm", pointJson(ct.central[0].distal)}};
}

/// The same options give the same UIDs, others give others.
DicomWriting seriesOf(const SampleCt& ct, const SampleCtOptions& options) {
  DicomWriting writing;
  writing.identity = "pneuma sample " + toJson(options).dump();
  writing.leftOut = ct.missing;
  return writing;
}

void writeCt(const std::filesystem::path& folder, const SampleCt& ct, const DicomWriting& writing,
             const CommonOptions& common, OutputSet& outputs, const Progress& progress) {
  outputs.add(folder / CtName);
  writeVolume(folder / CtName, ct.image, common.existing(),
              progress.part(0.0, 0.6, "writing the volume"));
  outputs.add(folder / LabelsName);
  writeVolume(folder / LabelsName, ct.truth, common.existing(),
              progress.part(0.6, 0.8, "writing the labels"));
  outputs.addFolder(folder / DicomName);
  for (const std::string& name : dicomFileNames(ct.image, writing)) {
    outputs.add(folder / DicomName / name);
  }
  writeDicomSeries(folder / DicomName, ct.image, writing, common.existing(),
                   progress.part(0.8, 1.0, "writing the series"));
}

/// What is known about the chest without measuring its files.
Json truth(const SampleChest& chest, const SampleArguments& arguments) {
  Json parameters = {{"cell_mm", arguments.cellMm}};
  const std::uint64_t seed = arguments.ct ? arguments.ctOptions.seed : 0;
  Json report = reportEnvelope("pneuma/sample/1", {}, parameters, seed);
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
    Json waves = Json::array();
    for (const FissureWave& wave : fissure.waves) {
      waves.push_back({{"amplitude_mm", wave.amplitudeMm},
                       {"x_per_mm", wave.xPerMm},
                       {"y_per_mm", wave.yPerMm},
                       {"phase", wave.phase}});
    }
    report["fissures"].push_back(
        {{"name", fissure.name},
         {"equation",
          "z = height + slope y + bend y^2 + side_bend (x - side)^2 + sum over waves of amplitude "
          "sin(x_per_mm x + y_per_mm y + phase)"},
         {"height_mm", fissure.heightMm},
         {"slope", fissure.slope},
         {"bend_per_mm", fissure.bend},
         {"side_bend_per_mm", fissure.sideBend},
         {"side_mm", fissure.sideMm},
         {"waves", waves}});
  }
  return report;
}

/// Points on the true fissures, as `pneuma lobes` takes them.
GivenFissures givenFissures(const SampleChest& chest) {
  GivenFissures given;
  for (const SampleFissure& fissure : chest.fissures) {
    given[*fissureOfShortName(fissure.name)].points = fissure.points;
  }
  return given;
}

std::string sizeText(const CtImage& image) {
  const ImageGeometry& geometry = image.geometry;
  return std::to_string(geometry.size[0]) + " x " + std::to_string(geometry.size[1]) + " x " +
         std::to_string(geometry.size[2]) + " voxels of " + fixed(geometry.spacing.x(), 2) + " x " +
         fixed(geometry.spacing.y(), 2) + " x " + fixed(geometry.spacing.z(), 2) + " mm";
}

/// Options of the CT: flags for what is on or off, the rest with their values.
void addCtOptions(CLI::App& app, SampleArguments& arguments) {
  app.add_flag("--ct", arguments.ct,
               "Write a CT of the chest too: ct.nii.gz, labels.nii.gz and dicom/.");
  forEachField<SampleCtOptions>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
    SampleCtOptions& options = arguments.ctOptions;
    if constexpr (std::is_same_v<Value, bool>) {
      arguments.ctFlags.push_back(app.add_flag("--" + std::string(field.name),
                                               options.*(field.member), std::string(field.help)));
    } else {
      arguments.ctFlags.push_back(addField(app, options, field));
    }
  });
}

ExitCode runSample(const SampleArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  requireNotWithoutCt(arguments);
  requireUsable(arguments, common);
  const double made = arguments.ct ? 0.2 : 1.0;
  SampleChest chest = sampleChest(arguments.cellMm, progress.part(0.0, made, "making a chest"));
  std::optional<SampleCt> ct;
  DicomWriting writing;
  if (arguments.ct) {
    ct = sampleCt(chest, arguments.ctOptions, progress.part(made, 0.7, "making a CT"));
    writing = seriesOf(*ct, arguments.ctOptions);
    requireNoOtherSlices(arguments.folder / DicomName, dicomFileNames(ct->image, writing),
                         common.existing());
    if (arguments.ctOptions.mirror) chest = mirrored(std::move(chest));
  }
  Json report = truth(chest, arguments);
  if (ct) report["ct"] = ctTruth(*ct, arguments.ctOptions);

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
  outputs.add(arguments.folder / FissuresName);
  writeFissures(arguments.folder / FissuresName, givenFissures(chest));
  if (ct) {
    writeCt(arguments.folder, *ct, writing, common, outputs, progress.part(0.7, 1.0, "writing"));
  }
  progress.report(1.0);
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
    std::cout << arguments.folder.string() << ": five lobes, " << CentralName << ", "
              << FissuresName << ", " << TruthName << "\n"
              << table(rows);
    if (ct) {
      std::cout << CtName << ", " << LabelsName << ", " << DicomName << ": " << sizeText(ct->image)
                << ", right lung " << fixed(labelMl(ct->truth, Lobe::RightLung), 1)
                << " ml, left lung " << fixed(labelMl(ct->truth, Lobe::LeftLung), 1)
                << " ml without airways of " << fixed(labelMl(ct->truth, Lobe::Central), 1)
                << " ml\n";
      if (!ct->missing.empty()) {
        std::cout << "missing in " << DicomName << ": " << ct->missing.size() << " slices\n";
      }
    }
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
  addCtOptions(app, *arguments);
  addForce(app, common);
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runSample(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
