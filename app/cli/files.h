#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "pipeline/lung_model.h"

namespace pneuma::cli {

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

/// Throws now if the folder is not there and cannot be made. @throws OutputFailed
void requireFolderOutput(const std::filesystem::path& folder);

/// What was read must not be replaced by what is made of it.
/// @throws InvalidOption if the output is one of the inputs, by whatever path
void requireOtherThanInputs(const std::filesystem::path& output,
                            std::span<const std::filesystem::path> inputs);

bool isTreeFileName(const std::filesystem::path& path);

/// The files one command writes: all of them, or none. Whatever was announced with add() is removed
/// again unless keep() is called, and what it was to replace is brought back.
class OutputSet {
 public:
  OutputSet() = default;
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  /// Call directly before a file is written. One that exists already is there all the time, the old
  /// one or the new one.
  /// @param aside the folder that keeps it till then, for files in many folders of one disk; else
  /// its own
  void add(const std::filesystem::path& path, const std::filesystem::path& aside = {});

  /// Makes a folder, unless it exists. @throws OutputFailed
  void addFolder(const std::filesystem::path& path);

  void keep();

 private:
  /// Second names for files of one folder that are going to be replaced, until all are: in a hidden
  /// folder that is locked, or others might take it for abandoned.
  class Aside {
   public:
    explicit Aside(const std::filesystem::path& folder);
    ~Aside();
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;

    void keep(const std::filesystem::path& file);
    void bringBack();

   private:
    std::filesystem::path path_;
    int lock_ = -1;

    struct Kept {
      std::filesystem::path file;
      std::filesystem::path second;
      bool noted = false;  ///< see noteReplaced()
    };

    std::vector<Kept> files_;
  };

  std::vector<std::filesystem::path> added_;
  std::map<std::filesystem::path, Aside> replaced_;  ///< by their folder
};

}  // namespace pneuma::cli
