#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/json.h"
#include "io/staged_folder.h"
#include "pipeline/run_recipe.h"

namespace pneuma {

/// The folder of a run and what run.json there says of it: which stage left which files, with their
/// hashes. Nothing else in the folder is touched.
class RunFolder {
 public:
  /// A run.json that cannot be read, or is no run's, counts as none.
  explicit RunFolder(std::filesystem::path path);

  std::filesystem::path operator/(const std::string& file) const { return path_ / file; }

  /// Throws if a file of these could not be written: it is another's, or was changed since a run
  /// left it. @throws OutputFailed
  void requireOwn(const std::vector<std::string>& files);

  /// True if a stage was done with this key and its files are as it left them.
  bool holds(Stage stage, const std::string& key);

  /// Takes over what the run before says of a stage.
  StageResult keep(Stage stage);

  /// Moves what a stage wrote aside to its place, removes what else the run before left of this
  /// stage and of those after it, and writes a run.json that tells of it. Until then run.json tells
  /// of the old files and of the new ones, so that a run that is killed can be done again.
  /// @throws OutputFailed: nothing was changed, unless it is run.json that cannot be written in the
  /// end
  void place(StagedFolder& staged, const StageResult& result, const std::string& key);

  /// True if a stage, done now or kept, left this file.
  bool left(Stage stage, const std::string& file) const;

 private:
  /// Of a file that is there, else empty.
  const std::string& hashOf(const std::string& file);

  /// True if it is as some run left it.
  bool isOwn(const std::string& file);

  /// What the run before left of this stage and of those after it, but for files that are made
  /// anew. From now on that run is not asked for them.
  std::vector<std::string> takeOutdated(Stage stage, const std::vector<std::string>& anew);
  [[noreturn]] void refuse(const std::string& file, const std::string& why) const;

  std::filesystem::path path_;
  Json before_;  ///< stages of the run before by name, or empty
  Json now_;
  std::map<std::string, std::string> hashes_;  ///< hashing takes its time: once for each file
};

/// As text for a file; bytes that are no UTF-8 are replaced.
std::string textOf(const Json& json);

}  // namespace pneuma
