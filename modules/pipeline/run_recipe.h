#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/atomic_file.h"
#include "pipeline/recipe.h"

namespace pneuma {

/// Names of what a run leaves in its folder.
namespace run_files {
inline constexpr const char* Labels = "labels.nii.gz";
inline constexpr const char* Central = "central.vtp";
inline constexpr const char* Lungs = "lungs.json";
inline constexpr const char* Lobes = "lobes";  ///< a folder, lobe_files.h
inline constexpr const char* Tree = "tree.vtp";
inline constexpr const char* Growth = "growth.json";
inline constexpr const char* State = "run.json";
}  // namespace run_files

struct RunOptions {
  std::filesystem::path folder;
  Stage from = Stage::Open;    ///< this stage and those after it are done anew
  bool anew = false;           ///< `from` was asked for; else what is there already is kept
  Stage upTo = Stage::Export;  ///< the last stage that is done
  bool dryRun = false;         ///< only say what would be done
  Existing existing = Existing::Refuse;  ///< files that are there and not as a run left them
};

/// What became of a stage.
enum class StageState { Done, Kept, Planned, NotAsked };

constexpr auto choices(StageState) {
  return std::array<std::string_view, 4>{"done", "kept", "to do", "not asked for"};
}

struct StageResult {
  Stage stage = Stage::Open;
  StageState state = StageState::NotAsked;
  double seconds = 0.0;
  std::vector<std::string> files;     ///< in the folder
  std::vector<std::string> warnings;  ///< whole sentences
  std::uint64_t memoryBytes = 0;      ///< that it takes, about; 0: it is kept, or not asked for
};

/// Does a recipe: CT, lungs and central airways, lobes, a grown tree, files of further formats. A
/// stage whose input, options and program are those of the run before, and whose files are still
/// what they were, is kept: run.json in the folder holds their hashes. Files are written aside and
/// renamed, run.json last, so that a run that is stopped leaves nothing that counts as done. What a
/// run before left of a stage that is done anew, and of those after it, is removed; a file that is
/// not as a run left it stops the run before it begins, and the CT is never overwritten. So does a
/// stage that would not fit into memory.
/// @throws as readCt(), requireStageFits(), segmentLungs(), splitLobes(), growAirways();
/// OutputFailed; Cancelled
std::vector<StageResult> runRecipe(const Recipe& recipe, const RunOptions& options,
                                   const Progress& progress = {});

}  // namespace pneuma
