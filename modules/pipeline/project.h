#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/json.h"
#include "io/member_archive.h"
#include "pipeline/breathe.h"
#include "pipeline/lobe_edits.h"
#include "pipeline/lung_corrections.h"
#include "pipeline/split_lobes.h"

namespace pneuma {

/// One moment of the work on a person's lungs: what was found, and what it was found with.
struct ProjectState {
  std::string name;  ///< of the case, as it is shown: file names only, never folders
  LungModel model;
  LungOptions lungOptions;  ///< with which model.lungs were found
  bool lungsFollow = true;  ///< surfaces and figures of the lungs are those of model.corrections.
                            ///< Of moments to undo, labels that come by corrections are left out
  LobeEdits lobeEdits;      ///< for the next split
  LobeEdits splitEdits;     ///< with which model.lobes were made
  std::map<Fissure, FissureReview> reviews;
  std::shared_ptr<const std::vector<LobeSurface>> grownIn;  ///< the surfaces of model.growth
  std::optional<BreatheOptions> breath;                     ///< with which the lungs breathe
};

/// A moment that undo goes back to, or redo goes on to.
struct ProjectStep {
  std::string name;  ///< what was done between it and the moment nearer to now: "grow airways"
  ProjectState state;
};

/// What the next growth, search and breath are done with.
struct NextOptions {
  std::vector<GrowthOptions> growth;  ///< of every method, in the order of growthMethods()
  std::size_t method = 0;
  LungOptions lungs;
  BreatheOptions breathe;
};

/// What a project held that this version does not know: it goes back into the file.
struct UnknownParts {
  Json fields = Json::object();  ///< of project.json, where they stood
  std::vector<ArchiveMember> members;
};

enum class CtStorage {
  Linked,  ///< by path, size and hash
  Packed   ///< its voxels are in the project too
};

/// Everything that a project file holds.
struct Project {
  ProjectState state;
  std::vector<ProjectStep> undo;  ///< oldest first
  std::vector<ProjectStep> redo;  ///< what was undone last first
  NextOptions next;
  Json view = Json::object();  ///< what the window shows, and from where
  std::string thumbnail;       ///< a PNG; may be empty
  CtStorage ctStorage = CtStorage::Linked;
  UnknownParts unknown;
  std::vector<std::string> notes;  ///< sentences about opening it, not saved
};

/// The newest version of the schema of project.json that this program reads. A file has the oldest
/// one whose programs do not misread it: 1, or 2 where something can be done again.
inline constexpr int ProjectVersion = 2;

/// So many steps are saved, those to undo and those to do again together.
inline constexpr std::size_t MostSavedSteps = 100;

/// Gives every moment that has the one CT's source the other.
void replaceCtSource(Project& project, const std::shared_ptr<const CtSource>& before,
                     const std::shared_ptr<const CtSource>& after);

/// Saves a project (docs/project-file.md): the old file whole or the new one at any moment, the one
/// before as NAME.pneuma~. A CT that was packed before stays so.
/// @throws OutputFailed; Unsupported for regions that are neither of surfaces nor of a built-in
/// organ of its own size; InputMissing if the CT to link is gone; Cancelled
void writeProject(const std::filesystem::path& path, const Project& project,
                  const Progress& progress = {});

/// Opens a project as it was saved. A CT that is not where it was, or not the same any more, is
/// left out, and `notes` says so.
/// @throws InputMissing; InvalidInput (damaged, cut off, no project); Unsupported (of a newer
/// Pneuma); Error (OutOfMemory); Cancelled
Project readProject(const std::filesystem::path& path, const Progress& progress = {});

/// The same as two steps without files: the members of the archive.
/// @param folder that paths are relative to
std::vector<ArchiveMember> projectMembers(const Project& project,
                                          const std::filesystem::path& folder,
                                          const Progress& progress = {});
Project projectOf(std::vector<ArchiveMember> members, const std::filesystem::path& folder,
                  const std::string& name, const Progress& progress = {});

}  // namespace pneuma
