#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"

namespace pneuma {

/// The files of a zip archive, in a folder that only this user may enter and that goes away with
/// the last copy of `folder`.
struct Unzipped {
  struct File {
    std::filesystem::path path;
    std::string name;  ///< in the archive
  };

  std::shared_ptr<const void> folder;
  std::vector<File> files;
};

bool isZipFile(const std::filesystem::path& path);

/// Unpacks the regular files. Their sizes are added up before the first is written.
/// @throws InvalidInput if the archive is damaged, leads out of its folder, or swells beyond
/// measure; Unsupported if it is encrypted; OutputFailed if the disk is full; Cancelled
Unzipped unzipped(const std::filesystem::path& archive, const Progress& progress);

}  // namespace pneuma
