#include "pipeline/lung_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "anatomy/central_airways.h"
#include "anatomy/lobar_bronchi.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/seconds.h"
#include "geometry/surface_domain.h"
#include "io/input_files.h"
#include "io/piece_files.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/figure_table.h"
#include "pipeline/label_fit.h"
#include "pipeline/lobe_parts.h"
#include "pipeline/project.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

bool isFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// The files of a folder that are surfaces of a lobe or a lung by name, sorted.
/// @throws Unsupported if some of it is in pieces
std::vector<fs::path> lobeFilesIn(const fs::path& folder) {
  requireWhole(folder);
  std::vector<fs::path> files = filesIn(folder);
  // A lobe's name on what is no file, such as a link that leads nowhere: reading it says so.
  for (fs::path& path : unreadableIn(folder)) files.push_back(std::move(path));
  std::ranges::sort(files);
  std::erase_if(files, [](const fs::path& file) {
    return !isSurfaceFileName(file) || !lobeOfFileName(file.filename().string()).has_value();
  });
  return files;
}

/// @throws InvalidInput for a folder that has no slices of a CT and no lobes
void requireSomethingIn(const fs::path& folder) {
  if (!lobeFilesIn(folder).empty()) return;
  const std::size_t files = filesIn(folder).size();
  throw InvalidInput(
      "the folder " + quoted(folder) + " holds neither slices of a CT nor a lobe " + "surface, " +
      (files == 0 ? "no file at all"
                  : "only " + std::to_string(files) + " other " + (files == 1 ? "file" : "files")) +
      "; slices are DICOM, and the names of lobes' files must carry rul, rml, rll, "
      "lul or lll and end in .stl, .obj, .ply or .vtp");
}

std::vector<fs::path> expanded(std::span<const fs::path> paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (!isFolder(path)) {
      files.push_back(path);
      continue;
    }
    const std::vector<fs::path> found = lobeFilesIn(path);
    if (found.empty()) {
      throw InvalidInput("the folder " + quoted(path) +
                         " holds no lobe surface; file names must carry rul, rml, rll, lul or lll "
                         "and end in .stl, .obj, .ply or .vtp");
    }
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

/// Lobes by file name; a single file may be called anything.
std::vector<Lobe> lobesOf(const std::vector<fs::path>& files) {
  std::vector<Lobe> lobes;
  for (const fs::path& file : files) {
    const std::optional<Lobe> lobe = lobeOfFileName(file.filename().string());
    if (!lobe.has_value() && files.size() > 1) {
      throw InvalidInput("which lobe is " + quoted(file) +
                         "? Among several surfaces, each file name must carry rul, rml, rll, lul "
                         "or lll");
    }
    const Lobe named = lobe.value_or(Lobe::Whole);
    const auto before = std::ranges::find(lobes, named);
    if (before != lobes.end()) {
      throw InvalidInput(quoted(files[static_cast<std::size_t>(before - lobes.begin())]) + " and " +
                         quoted(file) + " are both the " + std::string(longName(named)) +
                         " by name; give one file per lobe");
    }
    lobes.push_back(named);
  }
  return lobes;
}

}  // namespace

void requireOrganSize(const LobeSurface& surface) {
  constexpr double LargestMm = 1e4;
  const double size = surface.health.box.sizes().maxCoeff();
  if (size <= LargestMm) return;
  throw InvalidInput("'" + surface.name + "' is " + fixed(size / 1000.0, 0) +
                     " m large, if it is in mm; scale it to millimetres");
}

namespace {

/// @throws InvalidInput if a surface is not fit to grow in
void requireFit(const LobeSurface& surface) {
  const MeshReport& health = surface.health;
  if (health.unitsGuess == "m") {
    throw InvalidInput("'" + surface.name + "' is " + fixed(health.box.sizes().maxCoeff(), 2) +
                       " mm large: it seems to be in metres; convert it with 'pneuma export "
                       "--from-units m'");
  }
  requireOrganSize(surface);
  if (health.fitToGrow()) return;
  const std::vector<std::string> wrong = complaints(health);
  throw InvalidInput("'" + surface.name + "' is not fit to grow in: " +
                     (wrong.empty() ? "it encloses no volume" : wrong.front()));
}

std::shared_ptr<const std::vector<LobeRegion>> regionsOf(const std::vector<LobeSurface>& surfaces) {
  for (const LobeSurface& surface : surfaces) requireFit(surface);
  auto regions = std::make_shared<std::vector<LobeRegion>>(surfaces.size());
  parallelFor(surfaces.size(), [&](std::size_t i) {
    (*regions)[i] = {surfaces[i].lobe, std::make_shared<SurfaceDomain>(*surfaces[i].mesh)};
  });
  return regions;
}

bool hasGrownBranches(const AirwayTree& tree) {
  return std::ranges::any_of(tree, [](const Branch& b) { return b.origin == Origin::Grown; });
}

/// What a person should know of lobes that the central airways end before.
std::string sentenceOf(std::span<const Lobe> ledInto) {
  std::string lobes;
  for (std::size_t i = 0; i < ledInto.size(); ++i) {
    if (i > 0) lobes += i + 1 < ledInto.size() ? ", " : " and ";
    lobes += longName(ledInto[i]);
  }
  return "the central airways end before the " + lobes +
         ": a straight airway leads into each from the nearest branch, marked as template";
}

/// A central tree that says nothing of lobes; which lobe each branch serves shows when it is grown
/// from.
std::shared_ptr<const AirwayTree> asCentral(AirwayTree tree) {
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i].lobe == Lobe::Whole) tree.setLobe(i, Lobe::Central);
  }
  return std::make_shared<const AirwayTree>(std::move(tree));
}

/// Radiodensities need more than a byte, labels do not.
bool isLabelFile(const fs::path& path) {
  return isVolumeFile(path) && readVolumeHeader(path).scalarType == "uint8";
}

void addCt(LungModel& model, const fs::path& path, const CtReading& reading,
           const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const LungModel read = openCt(path, reading.corrections, progress, reading.series);
  model.ct = read.ct;
  model.ctSource = read.ctSource;
  model.inputs.insert(model.inputs.end(), read.inputs.begin(), read.inputs.end());
  model.warnings.insert(model.warnings.end(), read.warnings.begin(), read.warnings.end());
  model.readSeconds += secondsSince(start);
}

LungModel modelOfProject(std::span<const fs::path> paths, const Progress& progress) {
  if (paths.size() > 1) {
    throw InvalidInput("a project is opened alone, without " +
                       quoted(isProjectFileName(paths[0]) ? paths[1] : paths[0]) +
                       "; 'pneuma export' makes files of what is in it");
  }
  Project project = readProject(paths[0], progress);
  LungModel& model = project.state.model;
  model.inputs = {inputFile(paths[0])};
  model.warnings.insert(model.warnings.end(), project.notes.begin(), project.notes.end());
  return std::move(model);
}

void addLabels(LungModel& model, const fs::path& path, const Progress& progress) {
  model.labels = std::make_shared<const LabelImage>(readLabelVolume(path, progress));
  model.lungs = nullptr;
  model.corrections = nullptr;
  requireSamePlace(model);
  warnOfMisfit(model);
  model.inputs.push_back(inputFile(path));
}

}  // namespace

InputFile inputFile(const fs::path& path, const Progress& progress) {
  return {path.string(), sha256OfFile(path, progress)};
}

void requireSamePlace(const LungModel& model) {
  if (!model.ct || !model.labels ||
      model.labels->geometry.bounds().intersects(model.ct->geometry.bounds())) {
    return;
  }
  throw InvalidInput("the labels lie elsewhere than the CT; they belong to another image");
}

void warnOfMisfit(LungModel& model) {
  if (!model.ct || !model.labels) return;
  if (auto warning = misfitOf(*model.ct, *model.labels)) {
    model.warnings.push_back(std::move(*warning));
  }
}

std::shared_ptr<const AirwayTree> treeOf(const LungModel& model) {
  if (model.growth) {
    // Shares the growth's life, points at its tree.
    return {model.growth, &model.growth->result.tree};
  }
  return model.opened ? model.opened : model.central;
}

LungModel openLobes(std::span<const fs::path> paths, const Progress& progress) {
  if (std::ranges::any_of(paths, isProjectFileName)) return modelOfProject(paths, progress);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<fs::path> files = expanded(paths);
  if (files.empty()) throw InvalidInput("there is no surface to open");
  const std::vector<Lobe> lobes = lobesOf(files);

  LungModel model;
  model.inputs.resize(files.size());
  auto surfaces = std::make_shared<std::vector<LobeSurface>>(files.size());
  std::vector<std::vector<std::string>> notes(files.size());
  parallelFor(files.size(), [&](std::size_t i) {
    progress.throwIfStopped();
    SurfaceFile file = readSurface(files[i]);
    model.inputs[i] = inputFile(files[i]);
    for (std::string& note : file.notes) {
      notes[i].push_back(files[i].filename().string() + ": " + note);
    }
    const auto take = [&](LobeSurface& surface, Lobe lobe, TriangleMesh mesh) {
      surface.lobe = lobe;
      surface.name = files[i].filename().string();
      surface.health = examine(mesh, SelfIntersections::Ask, progress);
      surface.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    };
    std::map<Lobe, TriangleMesh> parts;
    if (files.size() == 1) parts = lobeParts(file.mesh, file.lobes);
    if (parts.empty()) parts.emplace(lobes[i], std::move(file.mesh));
    if (files.size() == 1) surfaces->resize(parts.size());
    std::size_t n = i;
    for (auto& [lobe, mesh] : parts) take((*surfaces)[n++], lobe, std::move(mesh));
  });
  for (const auto& some : notes) {
    model.warnings.insert(model.warnings.end(), some.begin(), some.end());
  }
  for (const LobeSurface& surface : *surfaces) {
    if (surface.health.unitsGuess == "cm") {
      model.warnings.push_back(surface.name + " is small for a human lobe: is it in centimetres?");
    }
    if (surface.health.fitToGrow() && !surface.health.healthy()) {
      model.warnings.push_back(
          surface.name + ": " + std::to_string(surface.health.selfIntersections) +
          " pairs of triangles cut each other; few enough to grow in, and 'pneuma repair' mends "
          "them");
    }
  }
  std::ranges::stable_sort(*surfaces, {}, &LobeSurface::lobe);
  model.surfaces = std::move(surfaces);
  model.readSeconds = secondsSince(start);
  progress.report(1.0);
  return model;
}

LungModel withCentral(const LungModel& model, const fs::path& path) {
  const auto start = std::chrono::steady_clock::now();
  LungModel next = model;
  TreeFile file = readTree(path);
  if (hasGrownBranches(file.tree)) {
    throw InvalidInput(quoted(path) +
                       " holds a grown tree, not central airways; grow from the central airways it "
                       "was grown from");
  }
  for (const std::string& note : file.notes) {
    next.warnings.push_back(path.filename().string() + ": " + note);
  }
  next.central = asCentral(std::move(file.tree));
  next.inputs.push_back(inputFile(path));
  next.growth = nullptr;
  next.readSeconds += secondsSince(start);
  return next;
}

LungModel withLabels(const LungModel& model, const fs::path& path, const Progress& progress) {
  LungModel next = model;
  addLabels(next, path, progress);
  return next;
}

LungModel openFiles(std::span<const fs::path> paths, const Progress& progress) {
  return openFiles(paths, CtReading{}, progress);
}

LungModel openFiles(std::span<const fs::path> paths, const CtReading& reading,
                    const Progress& progress) {
  if (std::ranges::any_of(paths, isProjectFileName)) return modelOfProject(paths, progress);
  std::vector<fs::path> surfaces;
  std::vector<fs::path> trees;
  std::vector<fs::path> cts;
  std::vector<fs::path> labels;
  for (const fs::path& path : paths) {
    if (isCtPath(path)) {
      (isLabelFile(path) ? labels : cts).push_back(path);
    } else if (isFolder(path)) {
      requireSomethingIn(path);
      surfaces.push_back(path);
      for (const fs::path& file : filesIn(path)) {
        if (file.stem() == "central") trees.push_back(file);
      }
    } else if (std::error_code error; fs::exists(path, error) && isTreeFile(path)) {
      trees.push_back(path);
    } else {
      surfaces.push_back(path);
    }
  }
  for (const auto& volumes : {cts, labels}) {
    if (volumes.size() < 2) continue;
    throw InvalidInput(quoted(volumes[0]) + " and " + quoted(volumes[1]) +
                       " are two images of one kind; open one at a time");
  }
  LungModel model;
  if (!surfaces.empty()) model = openLobes(surfaces, progress.part(0.0, 0.5, "reading surfaces"));
  for (const fs::path& path : cts) {
    addCt(model, path, reading, progress.part(0.5, 0.8, "reading the CT"));
  }
  for (const fs::path& path : labels) {
    addLabels(model, path, progress.part(0.8, 0.9, "reading labels"));
  }
  for (const fs::path& path : trees) {
    progress.throwIfStopped();
    TreeFile file = readTree(path);
    for (const std::string& note : file.notes) {
      model.warnings.push_back(path.filename().string() + ": " + note);
    }
    if (hasGrownBranches(file.tree)) {
      model.opened = std::make_shared<const AirwayTree>(std::move(file.tree));
    } else {
      model.central = asCentral(std::move(file.tree));
    }
    model.inputs.push_back(inputFile(path));
  }
  progress.report(1.0);
  return model;
}

std::uint64_t seedOf(const GrowthOptions& options) {
  return std::visit([](const auto& o) { return o.seed; }, options);
}

GrowthOptions withSeed(GrowthOptions options, std::uint64_t seed) {
  std::visit([seed](auto& o) { o.seed = seed; }, options);
  return options;
}

LungModel readyToGrow(const LungModel& model) {
  if (!model.regions && (!model.surfaces || model.surfaces->empty())) {
    throw InvalidInput("there is no lobe to grow in; open the surfaces of the lobes first");
  }
  LungModel next = model;
  if (!next.regions) next.regions = regionsOf(*next.surfaces);
  if (!next.central) {
    next.central = std::make_shared<const AirwayTree>(templateAirways(*next.regions));
  }
  return next;
}

LungModel grow(const LungModel& model, const GrowthOptions& options, const Progress& progress) {
  auto start = std::chrono::steady_clock::now();
  progress.part(0.0, 0.1, "preparing the lobes").report(0.0);
  LungModel next = readyToGrow(model);
  auto growth = std::make_shared<Growth>();
  growth->options = options;
  growth->domainSeconds = secondsSince(start);
  start = std::chrono::steady_clock::now();
  const LedAirways led = ledIntoLobes(*next.central, *next.regions);
  growth->result =
      growAirways(led.airways, *next.regions, options, progress.part(0.1, 0.9, "growing"));
  if (!led.lobes.empty()) growth->result.warnings.push_back(sentenceOf(led.lobes));
  growth->growSeconds = secondsSince(start);
  const AirwayTree& tree = growth->result.tree;
  const Progress checking = progress.part(0.9, 1.0, "checking the tree");
  checking.report(0.0);
  growth->outside = outsideTheirLobe(tree, *next.regions);
  growth->efficiency =
      efficiency(tree, *next.regions, next.cubes, checking.part(0.5, 1.0, "checking the tree"));
  next.growth = std::move(growth);
  progress.report(1.0);
  return next;
}

}  // namespace pneuma
