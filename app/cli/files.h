#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "pipeline/lung_model.h"

namespace pneuma::cli {

/// The file's path and hash, for a report. @throws InputMissing
InputFile inputFile(const std::filesystem::path& path);

/// The surfaces and trees in a folder, in the order of names. @throws InputMissing if it cannot be
/// read
std::vector<std::filesystem::path> modelsIn(const std::filesystem::path& folder);

/// Files as they are, folders replaced by the surfaces and trees in them, in the order of names.
/// @throws InputMissing for a path that is not there or a folder without any
std::vector<std::filesystem::path> expanded(std::span<const std::filesystem::path> paths);

/// Throw now what would be thrown after the work: the output exists, has no folder, or an extension
/// that nothing is written in. requireOutput() takes any extension. @throws OutputFailed,
/// Unsupported
void requireOutput(const std::filesystem::path& path, Existing existing);
void requireTreeOutput(const std::filesystem::path& path, Existing existing);
void requireSurfaceOutput(const std::filesystem::path& path, Existing existing);
void requireVolumeOutput(const std::filesystem::path& path, Existing existing);
void requirePngOutput(const std::filesystem::path& path, Existing existing);

bool isTreeFileName(const std::filesystem::path& path);

/// The files one command writes: all of them, or none. Whatever was announced with add() is removed
/// again unless keep() is called.
class OutputSet {
 public:
  OutputSet() = default;
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  /// Call directly before a file is written. One that exists already is being replaced, and is
  /// left as it is if the writer fails.
  void add(const std::filesystem::path& path);

  /// Makes a folder, unless it exists. @throws OutputFailed
  void addFolder(const std::filesystem::path& path);

  void keep() { added_.clear(); }

 private:
  std::vector<std::filesystem::path> added_;
};

}  // namespace pneuma::cli
