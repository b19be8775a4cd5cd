#pragma once

#include <filesystem>

#include "io/atomic_file.h"

namespace pneuma {

/// Files that take their places in a folder together. They are written into a hidden folder beside
/// it, or in it where it is there already, which goes away unless keep() is called.
class StagedFolder {
 public:
  /// @param folder is made by keep() if it is not there; its parent has to be
  /// @throws OutputFailed naming the path and what to do
  explicit StagedFolder(std::filesystem::path folder);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return stage_; }

  /// Moves everything to its place; what cannot be moved brings everything back. A file that is
  /// replaced is there all the time, the old one or the new one.
  /// @throws OutputFailed: nothing was changed
  void keep(Existing existing);

 private:
  std::filesystem::path folder_;
  std::filesystem::path stage_;
  int lock_;  ///< tells others that it is in use
};

}  // namespace pneuma
