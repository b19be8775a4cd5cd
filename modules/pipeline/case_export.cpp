#include "pipeline/case_export.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/multiblock_file.h"
#include "io/staged_folder.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/breathe_files.h"
#include "pipeline/case_parts.h"
#include "pipeline/case_recipe.h"
#include "pipeline/case_report.h"
#include "pipeline/lobe_files.h"
#include "pipeline/lobe_labels.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr const char* TogetherFile = "case.vtm";
constexpr const char* BreathFile = "breath.pvd";
constexpr const char* ShareFile = "breath.glb";
constexpr const char* FilmFile = "breath.ogv";
constexpr const char* LabelStem = "labels";
constexpr std::array<const char*, 4> TreeFiles = {"tree.vtp", "tree.swc", "tree.csv", "tree.json"};
constexpr std::array<std::string_view, 4> SurfaceFormats = {"stl", "obj", "ply", "vtp"};
constexpr std::array<std::string_view, 3> LabelFormats = {"nii.gz", "nrrd", "mha"};
constexpr ArrayBytes PatchArrays{0, 1};  ///< on_fissure
constexpr double VoxelMm = 1.0;          ///< of labels where there is no image

bool hasSurfaces(const LungModel& model) { return model.surfaces && !model.surfaces->empty(); }

bool breathes(const ProjectState& state) { return state.breath && hasSurfaces(state.model); }

std::map<std::string, std::string> metadataOf(const LungModel& model, const AirwayTree* tree) {
  if (model.growth && tree == &model.growth->result.tree) return treeMetadata(model);
  return {{"version", versionText()}};
}

/// Where the pieces of a surface or a tree end; none of what is neither.
std::vector<std::size_t> pieceEnds(const CasePart& part, std::uint64_t largestBytes) {
  if (part.mesh) return pneuma::pieceEnds(*part.mesh, largestBytes);
  return part.tree ? pneuma::pieceEnds(*part.tree, largestBytes) : std::vector<std::size_t>();
}

/// Surfaces and trees of a case as blocks of files.
std::vector<Block> blocksOf(const ProjectState& state, std::uint64_t largestBytes) {
  std::vector<Block> blocks;
  for (const CasePart& part : partsOf(state)) {
    const std::size_t count = pieceEnds(part, largestBytes).size();
    if (count > 0) blocks.push_back({part.stem, pieceFiles(part.stem + ".vtp", count)});
  }
  if (!state.model.lobes) return blocks;
  for (const SplitLung& lung : state.model.lobes->lungs) {
    for (const Fissure fissure : fissuresOf(lung.side)) {
      const std::size_t count =
          pneuma::pieceEnds(fissurePatch(lung, fissure), largestBytes, PatchArrays).size();
      blocks.push_back({std::string(shortName(fissure)), pieceFiles(patchFile(fissure), count)});
    }
  }
  return blocks;
}

void writeFissurePatches(const fs::path& folder, const LobesOfLungs& lobes,
                         std::uint64_t largestBytes) {
  for (const SplitLung& lung : lobes.lungs) {
    for (const Fissure fissure : fissuresOf(lung.side)) {
      const TriangleMesh patch = fissurePatch(lung, fissure);
      SurfaceArrays arrays;
      const auto complete = lobes.complete.find(fissure);
      if (complete != lobes.complete.end()) {
        arrays.triangleMarks["on_fissure"] = complete->second.onSheet;
      }
      makeFolder((folder / patchFile(fissure)).parent_path());
      writeSurfacePieces(folder / patchFile(fissure), patch,
                         pneuma::pieceEnds(patch, largestBytes, PatchArrays), arrays);
    }
  }
}

/// What an earlier export left that ParaView would take for a part of this one.
/// @throws OutputFailed if a surface or a tree of it is divided otherwise
void requireNoOtherPieces(const fs::path& folder, const std::vector<Block>& blocks) {
  std::error_code error;
  for (const Block& block : blocks) {
    const std::size_t count = block.files.size();
    fs::path whole = block.files.front();
    if (count > 1) whole = whole.parent_path() += ".vtp";
    std::vector<fs::path> others = {count == 1 ? pieceFiles(whole, 2).front() : whole};
    if (count > 1) others.push_back(pieceFiles(whole, count + 1).back());
    for (const fs::path& other : others) {
      if (!fs::exists(folder / other, error)) continue;
      throw OutputFailed("'" + (folder / other).string() +
                         "' would stand beside this export, which divides it otherwise; remove "
                         "what is there, or choose another folder");
    }
  }
}

/// @param blocks blocksOf() the state
void writeForParaview(const fs::path& folder, const ProjectState& state,
                      const std::vector<Block>& blocks, const MadeBreath& breath,
                      std::uint64_t largestBytes, const Progress& progress) {
  for (const CasePart& part : partsOf(state)) {
    progress.throwIfStopped();
    const fs::path file = folder / (part.stem + ".vtp");
    const std::vector<std::size_t> ends = pieceEnds(part, largestBytes);
    if (part.mesh) writeSurfacePieces(file, *part.mesh, ends);
    if (part.tree) {
      writeTreePieces(file, *part.tree, metadataOf(state.model, part.tree.get()), ends);
    }
  }
  if (state.model.lobes) writeFissurePatches(folder, *state.model.lobes, largestBytes);
  writeMultiblock(folder / TogetherFile, blocks);
  progress.report(0.2);
  if (!breathes(state)) return;
  if (breath.lungs != nullptr) {
    Json report = *breath.report;
    hideFileNames(report);
    writeBreath(folder / BreathFile, *breath.lungs, report, progress.part(0.2, 1.0, ""),
                largestBytes);
    return;
  }
  const BreathingLungs lungs =
      breathe(state.model, *state.breath, progress.part(0.2, 0.6, "moving lungs"));
  Json report = breatheReport(state.model, lungs, *state.breath);
  hideFileNames(report);
  writeBreath(folder / BreathFile, lungs, report, progress.part(0.6, 1.0, "writing"), largestBytes);
}

void writeBreathOf(const ProjectState& state, const fs::path& file, const MadeBreath& breath,
                   const WriteBreathing& write, const Progress& progress) {
  if (breath.lungs != nullptr) {
    write(file, *breath.lungs, progress);
    return;
  }
  write(file, breathe(state.model, *state.breath, progress.part(0.0, 0.4, "moving lungs")),
        progress.part(0.4, 1.0, ""));
}

/// The format that is asked for, or the usual one.
std::string takenFormat(ExportPreset preset, std::string_view format) {
  const auto formats = formatsOf(preset);
  if (format.empty()) return formats.empty() ? std::string() : std::string(formats.front());
  if (std::ranges::find(formats, format) != formats.end()) return std::string(format);
  if (formats.empty()) {
    throw InvalidOption("--preset " + textOf(preset) + " decides its formats; leave out --as");
  }
  std::string known;
  for (const std::string_view one : formats) {
    known += (known.empty() ? "" : one == formats.back() ? " or " : ", ") + std::string(one);
  }
  throw InvalidOption("--preset " + textOf(preset) + " is written as " + known + ", not as '" +
                      std::string(format) + "'");
}

fs::path surfaceFile(const LobeSurface& surface, const std::string& format) {
  return lobeFile(surface.lobe).replace_extension("." + format);
}

fs::path labelFile(const std::string& format) { return LabelStem + ("." + format); }

void writeForPrinting(const fs::path& folder, const LungModel& model, const std::string& format,
                      const Progress& progress) {
  for (const LobeSurface& surface : *model.surfaces) {
    progress.throwIfStopped();
    writeSurface(folder / surfaceFile(surface, format), *surface.mesh);
  }
}

/// The labels of a case, with lobes where its lungs were split.
LabelImage labelsOf(LungModel model, const Progress& progress) {
  if (!model.lobes) return *model.labels;
  if (model.labels) return lobeLabels(*model.labels, *model.lobes, progress);
  model.surfaces = model.wholeLungs;
  return lobeLabels(lungLabels(model, VoxelMm, progress.part(0.0, 0.5, "")), *model.lobes,
                    progress.part(0.5, 1.0, ""));
}

void writeAirways(const fs::path& folder, const LungModel& model, const Progress& progress) {
  const auto tree = treeOf(model);
  for (const char* file : TreeFiles) {
    progress.throwIfStopped();
    writeTree(folder / file, *tree, metadataOf(model, tree.get()));
  }
}

[[noreturn]] void throwLack(ExportPreset preset, ExportLack lack) {
  const std::string start = "--preset " + textOf(preset) + " has nothing to write: ";
  switch (lack) {
    case ExportLack::Surfaces:
      throw InvalidInput(start + "the case has no surfaces of lungs or lobes");
    case ExportLack::Labels:
      throw InvalidInput(start + "the case has no labels, and no lungs that were split into lobes");
    case ExportLack::Tree:
      throw InvalidInput(start + "the case has no airways");
    case ExportLack::FoundLungs:
      throw InvalidInput(start + "the case has no lungs that were found in a CT");
    case ExportLack::Breath:
      throw InvalidInput(start +
                         "the case does not breathe; open it in the window, breathe in the step "
                         "Breathing and save it, or use 'pneuma breathe'");
    default:
      throw InvalidInput(start + "the case has neither surfaces nor airways");
  }
}

}  // namespace

ExportLack lackOf(ExportPreset preset, const ProjectState& state) {
  const LungModel& model = state.model;
  const bool tree = treeOf(model) != nullptr;
  switch (preset) {
    case ExportPreset::Paraview:
      return hasSurfaces(model) || tree ? ExportLack::Nothing : ExportLack::Anything;
    case ExportPreset::Print:
      return hasSurfaces(model) ? ExportLack::Nothing : ExportLack::Surfaces;
    case ExportPreset::Segmentation:
      return model.labels || (model.lobes && model.wholeLungs) ? ExportLack::Nothing
                                                               : ExportLack::Labels;
    case ExportPreset::Recipe:
      return hasRecipe(state) ? ExportLack::Nothing : ExportLack::FoundLungs;
    case ExportPreset::Share:
    case ExportPreset::Film:
      return breathes(state) ? ExportLack::Nothing : ExportLack::Breath;
    case ExportPreset::Tree:
      break;
  }
  return tree ? ExportLack::Nothing : ExportLack::Tree;
}

std::span<const std::string_view> formatsOf(ExportPreset preset) {
  if (preset == ExportPreset::Print) return SurfaceFormats;
  if (preset == ExportPreset::Segmentation) return LabelFormats;
  return {};
}

std::vector<fs::path> presetOutputs(ExportPreset preset, const ProjectState& state,
                                    const ExportFormat& format) {
  const std::string taken = takenFormat(preset, format.name);
  if (lackOf(preset, state) != ExportLack::Nothing) return {};
  std::vector<fs::path> files;
  switch (preset) {
    case ExportPreset::Paraview:
      for (const Block& block : blocksOf(state, format.largestFileBytes)) {
        files.insert(files.end(), block.files.begin(), block.files.end());
      }
      files.emplace_back(TogetherFile);
      if (!breathes(state)) return files;
      for (const fs::path& file :
           breathOutputs(BreathFile, state.model, *state.breath, format.largestFileBytes)) {
        files.push_back(file);
      }
      return files;
    case ExportPreset::Print:
      for (const LobeSurface& surface : *state.model.surfaces) {
        files.push_back(surfaceFile(surface, taken));
      }
      return files;
    case ExportPreset::Segmentation:
      return {labelFile(taken)};
    case ExportPreset::Recipe:
      return recipeFiles(state);
    case ExportPreset::Share:
      return {ShareFile};
    case ExportPreset::Film:
      return {FilmFile};
    case ExportPreset::Tree:
      break;
  }
  return {TreeFiles.begin(), TreeFiles.end()};
}

void writePreset(const fs::path& folder, ExportPreset preset, const ProjectState& state,
                 Existing existing, const Progress& progress, const MadeBreath& breath,
                 const ExportFormat& format, const WriteBreathing& writeBreathing) {
  const std::string taken = takenFormat(preset, format.name);
  const ExportLack lack = lackOf(preset, state);
  if (lack != ExportLack::Nothing) throwLack(preset, lack);
  StagedFolder staged(folder);
  switch (preset) {
    case ExportPreset::Paraview: {
      const std::vector<Block> blocks = blocksOf(state, format.largestFileBytes);
      requireNoOtherPieces(folder, blocks);
      if (breathes(state)) {
        requireNoOtherSeries(
            folder / BreathFile,
            breathOutputs(BreathFile, state.model, *state.breath, format.largestFileBytes));
      }
      writeForParaview(staged.path(), state, blocks, breath, format.largestFileBytes, progress);
      break;
    }
    case ExportPreset::Print:
      writeForPrinting(staged.path(), state.model, taken, progress);
      break;
    case ExportPreset::Segmentation:
      writeVolume(staged.path() / labelFile(taken),
                  labelsOf(state.model, progress.part(0.0, 0.8, "labelling")), Existing::Replace,
                  progress.part(0.8, 1.0, "writing"));
      break;
    case ExportPreset::Tree:
      writeAirways(staged.path(), state.model, progress);
      break;
    case ExportPreset::Recipe:
      writeRecipe(staged.path(), state);
      break;
    case ExportPreset::Share:
      writeBreathOf(state, staged.path() / ShareFile, breath, writeBreathing, progress);
      break;
    case ExportPreset::Film:
      writeBreathOf(state, staged.path() / FilmFile, breath, writeBreathing, progress);
      break;
  }
  progress.report(1.0);
  staged.keep(existing);
}

}  // namespace pneuma
