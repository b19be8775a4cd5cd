#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include "anatomy/branch_order.h"
#include "anatomy/validation.h"
#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/ct_report.h"
#include "cli/files.h"
#include "cli/mesh_report.h"
#include "cli/project_report.h"
#include "cli/text.h"
#include "io/ct_file.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "pipeline/orientation_check.h"
#include "pipeline/report.h"
#include "pipeline/stage_needs.h"

namespace pneuma::cli {
namespace {

struct FileInfo {
  Json json;
  std::string text;
};

std::string listed(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "  ! " + sentence + "\n";
  return text;
}

FileInfo surfaceInfo(const std::filesystem::path& path, const Progress& progress) {
  const SurfaceFile file = readSurface(path);
  const MeshReport health = examine(file.mesh, SelfIntersections::Ask, progress);
  const std::vector<std::string> wrong = complaints(health);
  const std::optional<Lobe> lobe = lobeOfFileName(path.filename().string());
  FileInfo info;
  info.json = {{"path", path.string()},
               {"kind", "surface"},
               {"format", file.format},
               {"space", file.space.empty() ? "LPS" : file.space},
               {"space_stated", !file.space.empty()},
               {"lobe", std::string(shortName(lobe.value_or(Lobe::Whole)))},
               {"health", toJson(health)},
               {"complaints", wrong},
               {"notes", file.notes}};
  info.text = path.string() + ": " + file.format + " surface" +
              (lobe ? ", " + std::string(longName(*lobe)) : std::string()) + ", frame " +
              (file.space.empty() ? "not stated, taken as LPS" : file.space) + "\n" +
              textOf(health) + listed(file.notes) + listed(wrong);
  if (wrong.empty()) {
    info.text += "  healthy: fit to grow in\n";
  } else if (health.fitToGrow() && health.unitsGuess == "mm") {
    info.text += "  fit to grow in all the same\n";
  }
  return info;
}

Json extremes(double low, double high) { return {{"min", low}, {"max", high}}; }

FileInfo treeInfo(const std::filesystem::path& path) {
  const TreeFile file = readTree(path);
  const AirwayTree& tree = file.tree;
  Box3 box;
  double length = 0.0;
  double smallestRadius = tree.empty() ? 0.0 : tree[0].radiusMm;
  double largestRadius = smallestRadius;
  Json origins = {{"measured", 0}, {"template", 0}, {"grown", 0}};
  static constexpr std::array<const char*, 3> OriginNames = {"measured", "template", "grown"};
  for (const Branch& branch : tree) {
    box.extend(branch.proximal);
    box.extend(branch.distal);
    length += lengthMm(branch);
    smallestRadius = std::min(smallestRadius, branch.radiusMm);
    largestRadius = std::max(largestRadius, branch.radiusMm);
    Json& count = origins[OriginNames[static_cast<std::size_t>(branch.origin)]];
    count = count.get<std::size_t>() + 1;
  }
  const std::vector<int> generation = generations(tree);
  const int deepest =
      generation.empty() ? 0 : *std::max_element(generation.begin(), generation.end());
  const std::vector<std::string> wrong = problems(tree);

  FileInfo info;
  info.json = {{"path", path.string()},
               {"kind", "tree"},
               {"format", file.format},
               {"branches", tree.size()},
               {"branches_contracted", contractChains(tree).size()},
               {"terminals", terminalCount(tree)},
               {"generations", deepest + 1},
               {"length_mm", length},
               {"radius_mm", extremes(smallestRadius, largestRadius)},
               {"origins", origins},
               {"metadata", file.metadata},
               {"complaints", wrong},
               {"notes", file.notes}};
  const Vec3 size = box.isEmpty() ? Vec3::Zero().eval() : box.sizes().eval();
  const auto count = [](std::size_t n) { return grouped(static_cast<double>(n)); };
  info.text = path.string() + ": " + file.format + " tree\n" +
              table({
                  {"branches", count(tree.size())},
                  {"without one-daughter steps", count(info.json.at("branches_contracted"))},
                  {"terminals", count(terminalCount(tree))},
                  {"generations", std::to_string(deepest + 1)},
                  {"size", fixed(size.x(), 1) + " x " + fixed(size.y(), 1) + " x " +
                               fixed(size.z(), 1) + " mm"},
                  {"length of all branches", fixed(length / 1000.0, 2) + " m"},
                  {"radius", fixed(smallestRadius, 2) + " to " + fixed(largestRadius, 2) + " mm"},
                  {"measured / template / grown", count(origins.at("measured")) + " / " +
                                                      count(origins.at("template")) + " / " +
                                                      count(origins.at("grown"))},
              }) +
              listed(file.notes) + listed(wrong);
  return info;
}

/// What is to be told of CTs.
struct CtWish {
  bool identifiers = false;  ///< names of people and places, too
  double resampleMm = 0.0;   ///< what the stages take is told for voxels of this side; 0: as it is
  SeriesChoice series;
};

/// "up to 590 MB of memory, 31 s of one core"
std::string textOfNeeds(const std::vector<StageNeed>& needs) {
  std::uint64_t most = 0;
  double seconds = 0.0;
  for (const StageNeed& need : needs) {
    most = std::max(most, need.bytes);
    seconds += need.seconds;
  }
  return "up to " + fixed(static_cast<double>(most) / 1e6, 0) + " MB of memory, " +
         fixed(seconds, 0) + " s of one core";
}

/// Missing slices are interpolated here, so that the rest of the card can be told with them.
/// @param inputs gets what was read, unless nullptr
FileInfo ctInfo(const std::filesystem::path& path, const CtWish& wish,
                std::vector<InputFile>* inputs, const Progress& progress) {
  const CtFile file =
      readCt(path, {.fillGaps = true}, progress.part(0.0, 0.3, "reading"), wish.series);
  if (inputs != nullptr) {
    inputs->push_back(ctInput(path, file, progress.part(0.3, 0.4, "hashing")));
  }
  FileInfo info;
  info.json = {{"path", path.string()}};
  info.json.update(ctJson(file, wish.identifiers));
  info.text = path.string() + ": " + file.format + " CT\n" + ctText(file, wish.identifiers);
  const std::vector<StageNeed> needs = stageNeeds(file.image.geometry, wish.resampleMm);
  info.json["needs"] = toJson(needs);
  info.text += "  all stages, to a tree that breathes: about " + textOfNeeds(needs) + "\n";
  const OrientationCheck check =
      checkOrientation(file.image, progress.part(0.4, 1.0, "looking which lung is the right one"));
  info.text += "  " + std::string(check.maybeSwapped() ? "! " : "") + check.sentence + "\n";
  info.json["orientation"] = {{"checked", check.hands.has_value()},
                              {"maybe_swapped", check.maybeSwapped()},
                              {"says", check.sentence}};
  if (check.hands) {
    info.json["orientation"]["votes"] = {{"heart", check.hands->heart},
                                         {"volume", check.hands->volume},
                                         {"dome", check.hands->dome}};
  }
  return info;
}

FileInfo projectInfo(const std::filesystem::path& path, const Progress& progress) {
  const Project project = readProject(path, progress);
  FileInfo info;
  info.json = {{"path", path.string()}};
  info.json.update(projectJson(project));
  info.text = path.string() + ": Pneuma project" +
              (project.state.name.empty() ? "" : " of " + project.state.name) + "\n" +
              projectText(project);
  return info;
}

/// CTs as they are, folders replaced by the surfaces and trees in them; of a folder that holds
/// both, both.
std::vector<std::filesystem::path> opened(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& path : paths) {
    std::vector<std::filesystem::path> models;
    if (!isCtPath(path)) {
      models = expanded({&path, 1});
    } else {
      files.push_back(path);
      std::error_code error;
      if (std::filesystem::is_directory(path, error)) models = modelsIn(path);
    }
    files.insert(files.end(), models.begin(), models.end());
  }
  return files;
}

ExitCode runInfo(const std::vector<std::filesystem::path>& paths, const CtWish& wish,
                 const CommonOptions& common, const Progress& progress) {
  const std::vector<std::filesystem::path> files = opened(paths);
  std::vector<InputFile> inputs;
  Json infos = Json::array();
  std::string text;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const double from = static_cast<double>(i) / static_cast<double>(files.size());
    const double to = static_cast<double>(i + 1) / static_cast<double>(files.size());
    FileInfo info;
    if (isProjectFileName(files[i])) {
      if (common.json) inputs.push_back(inputFile(files[i], progress.part(from, to, "hashing")));
      info = projectInfo(files[i], progress.part(from, to, "opening"));
    } else if (isCtPath(files[i])) {
      info = ctInfo(files[i], wish, common.json ? &inputs : nullptr,
                    progress.part(from, to, "reading"));
    } else {
      if (common.json) inputs.push_back(inputFile(files[i], progress.part(from, to, "hashing")));
      info = isTreeFile(files[i]) ? treeInfo(files[i])
                                  : surfaceInfo(files[i], progress.part(from, to, "examining"));
    }
    infos.push_back(info.json);
    text += (i == 0 ? "" : "\n") + info.text;
  }
  progress.report(1.0);
  if (common.json) {
    Json report = reportEnvelope("pneuma/info/1", inputs, Json::object(), 0);
    report["files"] = infos;
    text = jsonText(report);
  }
  std::cout << text;
  return ExitCode::Done;
}

}  // namespace

Run declareInfo(CLI::App& app, CommonOptions& common) {
  const auto files = std::make_shared<std::vector<std::filesystem::path>>();
  const auto wish = std::make_shared<CtWish>();
  addFiles(app, "FILES", *files,
           "Surfaces, trees, CTs (DICOM, zipped DICOM, NIfTI, NRRD, MHA), folders of them, or "
           "projects.")
      ->required();
  app.add_option("--series", wish->series.wanted,
                 "The series of a CT to tell of: its place in the list, its UID, or its name in a "
                 "project; else the best.")
      ->type_name("N|UID");
  app.add_option_function<std::string>(
         "--resample",
         [wish](const std::string& text) {
           CtCorrections corrections;
           setOption(corrections, "resample", text);
           wish->resampleMm = corrections.resampleMm;
         },
         "Say what a CT's stages take of memory and time after it was resampled to cubic voxels of "
         "this side; 0: as it is.")
      ->type_name("mm")
      ->default_str("0");
  app.add_flag("--phi", wish->identifiers,
               "Also print the names of people and places that DICOM holds.");
  addJson(app, common);
  return [files, wish, &common](const Progress& progress) {
    return runInfo(*files, *wish, common, progress);
  };
}

}  // namespace pneuma::cli
