#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "io/piece_files.h"
#include "pipeline/project.h"

namespace pneuma {

/// What a case is exported for: `pneuma export --preset`, and the window's step "Export".
enum class ExportPreset {
  Paraview,      ///< surfaces, fissures and trees as VTP with a .vtm that names them; the breath
  Print,         ///< every surface as STL, mm
  Segmentation,  ///< the labels, with lobes where lungs were split, as NIfTI
  Tree,          ///< the airways as VTP, SWC, CSV and JSON
  Recipe,        ///< what was done, for `pneuma run` to do it again
  Share,         ///< lungs and airways, breathing, as animated glTF
  Film           ///< a breath as a film
};

constexpr std::array<std::string_view, 7> choices(ExportPreset) {
  return {"paraview", "print", "segmentation", "tree", "recipe", "share", "film"};
}

/// What a case lacks for a preset.
enum class ExportLack { Nothing, Anything, Surfaces, Labels, Tree, FoundLungs, Breath };

ExportLack lackOf(ExportPreset preset, const ProjectState& state);

/// The extensions that a preset's files can have, the usual one first: of print "stl", "obj", "ply"
/// and "vtp", of segmentation "nii.gz", "nrrd" and "mha". Empty where there is no choice.
std::span<const std::string_view> formatsOf(ExportPreset preset);

/// How the files of a preset are written.
struct ExportFormat {
  std::string name;  ///< one of formatsOf(); empty: the usual one
  /// Of Paraview: a surface or a tree that would have more is written in pieces (piece_files.h),
  /// those of a breath, too. At least LeastFileBytes.
  std::uint64_t largestFileBytes = LargestFileBytes;
};

/// The files that writePreset() writes, relative to the folder.
/// @throws InvalidOption if the format is none of formatsOf()
std::vector<std::filesystem::path> presetOutputs(ExportPreset preset, const ProjectState& state,
                                                 const ExportFormat& format = {});

/// A breath that was made with the state's options already.
struct MadeBreath {
  const BreathingLungs* lungs = nullptr;  ///< null: it is made
  const Json* report = nullptr;           ///< its breatheReport()
};

/// Writes lungs that breathe into the file of a preset, aside. @throws what writing them throws
using WriteBreathing = std::function<void(const std::filesystem::path& file,
                                          const BreathingLungs& lungs, const Progress& progress)>;

/// Writes what a preset makes of a case into a folder: everything, or nothing. Names of the case
/// and its files go nowhere, but for the path of the CT in a recipe.
/// @throws InvalidInput if the case has nothing that the preset takes; OutputFailed, also where the
/// folder has a surface or a tree in other pieces; as breathe(); Cancelled
/// @throws InvalidOption for another format than those of formatsOf()
/// @param writeBreathing of Share and Film, which is drawn above this module: `exportCase()`
/// (views/case_export.h) has it. @pre there is one for these two
void writePreset(const std::filesystem::path& folder, ExportPreset preset,
                 const ProjectState& state, Existing existing, const Progress& progress = {},
                 const MadeBreath& breath = {}, const ExportFormat& format = {},
                 const WriteBreathing& writeBreathing = {});

}  // namespace pneuma
