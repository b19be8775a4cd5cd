#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/conversion.h"
#include "cli/files.h"
#include "cli/limits.h"
#include "cli/picture_arguments.h"
#include "cli/text.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/case_parts.h"
#include "views/case_export.h"

namespace pneuma::cli {
namespace {

namespace fs = std::filesystem;

enum class Format { Vtp, Stl, Ply, Obj, Swc, Csv, Json };

constexpr std::array<std::string_view, 7> choices(Format) {
  return {"vtp", "stl", "ply", "obj", "swc", "csv", "json"};
}

struct ExportArguments {
  std::vector<fs::path> inputs;
  std::vector<std::string> only;
  std::optional<ExportPreset> preset;
  ExportFormat as;          ///< of a preset
  std::string largestFile;  ///< as given, of a preset
  std::string view;         ///< of a film; empty: the case's
  Format format = Format::Vtp;
  LengthUnit fromUnits = LengthUnit::Mm;
  LengthUnit units = LengthUnit::Mm;
  Frame frame = Frame::Lps;

  static constexpr auto fields() {
    using E = ExportArguments;
    return std::tuple{
        Field{"format", &E::format, "", Range{}, "Format of the files where OUT is a folder."},
        Field{"from-units", &E::fromUnits, "", Range{}, "What the input is measured in."},
        Field{"units", &E::units, "", Range{},
              "What the output is measured in (surfaces; trees are in mm)."},
        Field{"frame", &E::frame, "", Range{}, "Frame of the output (surfaces; trees are in LPS)."},
    };
  }
};

/// One file in, one file out; or something in a project.
struct Job {
  fs::path input;
  fs::path output;
  bool isTree = false;
  std::optional<CasePart> part = {};

  std::string stem() const { return part ? part->stem : input.stem().string(); }

  /// Neither a surface nor a tree, and written as it is.
  bool isOther() const { return part && part->write; }
};

std::vector<Lobe> parsedLobes(const std::vector<std::string>& lists) {
  std::vector<Lobe> lobes;
  for (const std::string& list : lists) {
    for (std::size_t from = 0; from <= list.size();) {
      const std::size_t comma = std::min(list.find(',', from), list.size());
      const std::string name = list.substr(from, comma - from);
      const std::optional<Lobe> lobe = lobeOfShortName(name);
      if (!lobe) {
        throw InvalidOption("--only knows RUL, RML, RLL, LUL, LLL and central, but '" + name +
                            "' was given");
      }
      lobes.push_back(*lobe);
      from = comma + 1;
    }
  }
  return lobes;
}

bool isWanted(const Job& job, const std::vector<Lobe>& only) {
  if (only.empty() || job.isTree) return true;
  if (job.isOther()) return false;
  const std::optional<Lobe> lobe = lobeOfFileName(job.stem());
  return lobe && std::find(only.begin(), only.end(), *lobe) != only.end();
}

/// The files themselves, the surfaces in the folders, everything in the projects.
std::vector<Job> inputs(const std::vector<fs::path>& paths, const Progress& progress) {
  std::vector<Job> result;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (isProjectFileName(path)) {
      std::vector<CasePart> parts = partsOf(readProject(path, progress).state);
      if (parts.empty()) {
        throw InputMissing("the project '" + path.string() + "' holds nothing to export yet");
      }
      for (CasePart& part : parts) {
        const bool isTree = part.tree != nullptr;
        result.push_back({path, {}, isTree, std::move(part)});
      }
      continue;
    }
    const bool isFolder = fs::is_directory(path, error);
    for (const fs::path& file : expanded(std::vector{path})) {
      const Job job{file, {}, isTreeFile(file)};
      if (!isFolder || !job.isTree) result.push_back(job);
    }
  }
  return result;
}

bool holdsTrees(Format format) {
  return format != Format::Stl && format != Format::Obj && format != Format::Ply;
}

bool holdsSurfaces(Format format) { return format == Format::Vtp || !holdsTrees(format); }

/// A project has surfaces and trees: what the format does not hold goes to VTP.
std::string extensionOf(const Job& job, const ExportArguments& arguments) {
  if (!job.part) return textOf(arguments.format);
  if (job.isOther()) return job.part->file.substr(job.part->stem.size() + 1);
  const bool fits = job.isTree ? holdsTrees(arguments.format) : holdsSurfaces(arguments.format);
  return fits ? textOf(arguments.format) : "vtp";
}

/// Of a project's parts the one that a single file can be: its surface, its tree or its labels.
void chooseOne(std::vector<Job>& all, const std::vector<Lobe>& only, const fs::path& output) {
  const bool tree = isTreeFileName(output) && (only.empty() || !isSurfaceFileName(output));
  std::erase_if(all, [&](const Job& job) {
    if (isVolumeFileName(output)) return !job.isOther() || !isVolumeFileName(job.part->file);
    return job.isOther() || job.isTree != tree;
  });
  // What was grown comes before the central airways.
  if (tree && all.size() > 1) all.resize(1);
  if (all.size() == 1) return;
  throw InvalidOption("the project holds " + std::to_string(all.size()) +
                      " things that could become '" + output.string() +
                      "'; choose a lobe with --only, or name a folder for everything");
}

std::vector<Job> jobs(const ExportArguments& arguments, const std::vector<Lobe>& only,
                      const fs::path& output, const Progress& progress) {
  std::vector<Job> result;
  for (Job job : inputs(arguments.inputs, progress)) {
    job.output = output;
    if (isWanted(job, only)) result.push_back(job);
  }
  if (result.empty()) {
    throw InputMissing(
        "there is no surface to export among the inputs that --only leaves; check the file names");
  }
  std::error_code error;
  const bool isFolder = output.extension().empty() || fs::is_directory(output, error);
  if (!isFolder && result.front().part) chooseOne(result, only, output);
  if (isFolder || result.size() > 1) {
    for (Job& job : result) job.output = output / (job.stem() + "." + extensionOf(job, arguments));
  }
  return result;
}

void requireUsable(const std::vector<Job>& all, const ExportArguments& arguments,
                   const CommonOptions& common) {
  std::vector<fs::path> outputs;
  for (const Job& job : all) {
    // What shall become a tree and does not look like one: its reader says what is wrong with it.
    const bool wantsTree = isTreeFileName(job.output) && !isSurfaceFileName(job.output);
    if (wantsTree && !job.isTree && !job.part && isTreeFileName(job.input)) readTree(job.input);
    if (job.isTree && !job.part &&
        (arguments.units != LengthUnit::Mm || arguments.frame != Frame::Lps)) {
      throw InvalidOption(
          "trees are always written in LPS and mm, so --units and --frame do not go with '" +
          job.input.string() + "'");
    }
    if (std::find(outputs.begin(), outputs.end(), job.output) != outputs.end()) {
      throw InvalidOption("two inputs would be written to '" + job.output.string() +
                          "'; export them one by one");
    }
    outputs.push_back(job.output);
    requireOtherThanInputs(job.output, {&job.input, 1});
    std::error_code error;
    const bool folderComes =
        job.output.parent_path() == common.output && !fs::exists(common.output, error);
    if (folderComes) {
      requireOutput(common.output, common.existing());  // the folder itself can be made
    } else if (job.isOther()) {
      requireOutput(job.output, common.existing());
    } else if (job.isTree) {
      requireTreeOutput(job.output, common.existing());
    } else {
      requireSurfaceOutput(job.output, common.existing());
    }
  }
}

/// Returns what reading the input had to convert or leave out.
std::vector<std::string> run(const Job& job, const ExportArguments& arguments,
                             const std::vector<Lobe>& only) {
  if (job.isOther()) {
    job.part->write(job.output);
    return {};
  }
  if (job.isTree) {
    TreeFile file;
    if (job.part) {
      file.tree = *job.part->tree;
    } else {
      file = readTree(job.input);
    }
    AirwayTree tree = scaled(file.tree, millimetresIn(arguments.fromUnits));
    if (!only.empty()) tree = onlyLobes(tree, only);
    writeTree(job.output, tree, file.metadata);
    return std::move(file.notes);
  }
  SurfaceFile file;
  if (job.part) {
    file.mesh = *job.part->mesh;
  } else {
    file = readSurface(job.input);
  }
  const double factor = millimetresIn(arguments.fromUnits) / millimetresIn(arguments.units);
  TriangleMesh mesh = scaled(std::move(file.mesh), factor);
  const bool turn = arguments.frame == Frame::Ras;
  if (turn) mesh = turnedToOtherFrame(std::move(mesh));
  writeSurface(job.output, mesh, {turn ? "RAS" : "LPS", textOf(arguments.units)});
  return std::move(file.notes);
}

ExportPreset presetOf(const std::string& text) {
  constexpr auto names = choices(ExportPreset{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) return static_cast<ExportPreset>(i);
  }
  const std::string_view nearest = nearestWord(text, {names.begin(), names.end()});
  throw InvalidOption("--preset knows " + joinedChoices(names) + ", but '" + text + "' was given" +
                      (nearest.empty() ? "" : "; did you mean '" + std::string(nearest) + "'?"));
}

/// @throws InvalidOption for what a preset decides itself
void requirePresetAlone(const ExportArguments& arguments) {
  const ExportArguments defaults;
  std::string_view other;
  if (!arguments.only.empty()) other = "--only";
  if (arguments.format != defaults.format) other = "--format";
  if (arguments.fromUnits != defaults.fromUnits) other = "--from-units";
  if (arguments.units != defaults.units) other = "--units";
  if (arguments.frame != defaults.frame) other = "--frame";
  if (other.empty()) return;
  throw InvalidOption("--preset decides what is written and how; leave out " + std::string(other));
}

ExitCode runPreset(const ExportArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  requirePresetAlone(arguments);
  const bool film = arguments.preset == ExportPreset::Film;
  if (!arguments.view.empty() && !film) {
    throw InvalidOption("--view is of a film; leave it out, or give --preset film");
  }
  if (!arguments.view.empty()) (void)viewDirection(arguments.view);
  ExportFormat format = arguments.as;
  format.largestFileBytes = largestFileBytes(arguments.largestFile);
  if (film) requireDisplay();
  requireFolderOutput(common.output);
  const Project project = openCase(arguments.inputs, progress.part(0.0, 0.5, "reading"));
  const std::vector<fs::path> files = presetOutputs(*arguments.preset, project.state, format);
  for (const fs::path& file : files) {
    std::error_code error;
    if (fs::exists(common.output / file, error)) {
      requireOutput(common.output / file, common.existing());
      requireOtherThanInputs(common.output / file, arguments.inputs);
    }
  }
  const ViewDirection view =
      arguments.view.empty() ? savedView(project.view) : viewDirection(arguments.view);
  exportCase(common.output, *arguments.preset, project.state, view, common.existing(),
             progress.part(0.5, 1.0, "exporting"), {}, format);
  if (common.quiet) return ExitCode::Done;
  printWarnings(project.notes);
  for (const fs::path& file : files) std::cout << (common.output / file).string() << "\n";
  return ExitCode::Done;
}

ExitCode runExport(const ExportArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  if (!arguments.largestFile.empty() && arguments.preset != ExportPreset::Paraview) {
    throw InvalidOption("--largest-file goes with --preset paraview; leave it out");
  }
  if (arguments.preset) return runPreset(arguments, common, progress);
  if (!arguments.view.empty()) throw InvalidOption("--view goes with --preset film");
  if (!arguments.as.name.empty()) {
    throw InvalidOption("--as goes with --preset; else it is --format");
  }
  const std::vector<Lobe> only = parsedLobes(arguments.only);
  const std::vector<Job> all =
      jobs(arguments, only, common.output, progress.part(0.0, 0.5, "reading"));
  requireUsable(all, arguments, common);
  const Progress exporting = progress.part(0.5, 1.0, "exporting");
  OutputSet outputs;
  std::vector<std::string> notes;
  std::string text;
  if (all.front().output != common.output) outputs.addFolder(common.output);
  for (std::size_t i = 0; i < all.size(); ++i) {
    exporting.report(static_cast<double>(i) / static_cast<double>(all.size()));
    outputs.add(all[i].output);
    for (const std::string& note : run(all[i], arguments, only)) notes.push_back(note);
    text += all[i].input.string() + " -> " + all[i].output.string() + "\n";
  }
  progress.report(1.0);
  outputs.keep();
  if (!common.quiet) {
    printWarnings(notes);
    std::cout << text;
  }
  return ExitCode::Done;
}

}  // namespace

Run declareExport(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<ExportArguments>();
  addFiles(app, "INPUTS", arguments->inputs, "Surfaces, trees, folders of surfaces, or projects.")
      ->required();
  addOutput(
      app, common, "FILE",
      "The output: a file for one input, its format by the extension; a folder for several, or for "
      "a preset.")
      ->required();
  addRepeatable(app, "--only", arguments->only, "LOBES",
                "Only these lobes, for example RUL,LLL: files by their names, trees by branches.");
  app.add_option_function<std::string>(
         "--preset", [arguments](const std::string& text) { arguments->preset = presetOf(text); },
         "What it is for: paraview (VTP with a .vtm for all of it, the breath as .pvd), print (STL "
         "of every lobe, mm), segmentation (labels with lobes as NIfTI), tree (VTP, SWC, CSV and "
         "JSON), recipe (what was done, for 'pneuma run'); of a case that breathes share (animated "
         "glTF for web pages, Blender and slides) and film (a breath as .ogv). OUT is a folder, "
         "written whole or not at all.")
      ->type_name(choiceType(choices(ExportPreset{})));
  app.add_option("--as", arguments->as.name,
                 "Format of a preset's files, in place of the usual one: of print stl, obj, ply or "
                 "vtp; of segmentation nii.gz, nrrd or mha.")
      ->type_name("FORMAT");
  app.add_option("--largest-file", arguments->largestFile,
                 "Of --preset paraview: a surface or a tree that would make a larger file is "
                 "written in pieces, which a .vtm names; bytes, or as 500M "
                 "(default 2G).")
      ->type_name("SIZE");
  app.add_option("--view", arguments->view,
                 "From where --preset film looks: anterior, posterior, left, right, superior, "
                 "inferior, or AZ,EL in degrees; else as when the project was saved.")
      ->type_name("VIEW");
  addFields(app, *arguments);
  return [arguments, &common](const Progress& progress) {
    return runExport(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
