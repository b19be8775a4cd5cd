#include "io/staged_folder.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

#include "core/error.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr const char* OldOnes = ".replaced";

fs::path withoutSlash(fs::path folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

/// A folder of our own beside or in `folder`.
fs::path newStage(const fs::path& folder) {
  std::error_code error;
  const bool there = fs::is_directory(folder, error);
  if (!there && fs::exists(folder, error)) {
    throw OutputFailed("'" + folder.string() + "' is a file, not a folder; choose another name");
  }
  const std::string name = there ? std::string(".pneuma") : "." + folder.filename().string();
  const fs::path parent = there ? folder : folder.parent_path();
  for (int n = 0; n < 100; ++n) {
    const fs::path stage =
        parent / (name + "-" + std::to_string(::getpid()) + "-" + std::to_string(n));
    if (fs::create_directory(stage, error)) return stage;
    if (error) break;
  }
  throw OutputFailed("nothing can be written to '" + folder.string() + "'" +
                     (error ? ": " + error.message() : std::string()) +
                     "; make its parent folder first, or choose another");
}

std::vector<fs::path> filesUnder(const fs::path& stage) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(stage)) {
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(stage));
  }
  std::ranges::sort(files);
  return files;
}

/// Moves files one by one, and back again where one cannot be moved.
class Moves {
 public:
  Moves(fs::path from, fs::path to) : from_(std::move(from)), to_(std::move(to)) {}

  void move(const fs::path& file) {
    const fs::path target = to_ / file;
    const fs::path old = from_ / OldOnes / file;
    fs::create_directories(target.parent_path());
    const bool was = fs::exists(target);
    if (was) {
      fs::create_directories(old.parent_path());
      fs::rename(target, old);
    }
    done_.push_back({file, was});
    fs::rename(from_ / file, target);
  }

  void undo() noexcept {
    std::error_code ignored;
    for (auto move = done_.rbegin(); move != done_.rend(); ++move) {
      fs::remove(to_ / move->first, ignored);
      if (move->second) fs::rename(from_ / OldOnes / move->first, to_ / move->first, ignored);
    }
  }

 private:
  fs::path from_;
  fs::path to_;
  std::vector<std::pair<fs::path, bool>> done_;  ///< and whether one was there before
};

}  // namespace

StagedFolder::StagedFolder(fs::path folder)
    : folder_(withoutSlash(std::move(folder))), stage_(newStage(folder_)) {}

StagedFolder::~StagedFolder() {
  std::error_code ignored;  // already an error on its way out, or nothing to remove
  fs::remove_all(stage_, ignored);
}

void StagedFolder::keep(Existing existing) {
  const std::vector<fs::path> files = filesUnder(stage_);
  std::error_code error;
  if (!fs::exists(folder_, error)) {
    fs::rename(stage_, folder_, error);
    if (!error) return;
  }
  for (const fs::path& file : files) {
    if (existing == Existing::Refuse && fs::exists(folder_ / file, error)) {
      throw OutputFailed("'" + (folder_ / file).string() +
                         "' exists already; add --force to replace it, or choose another folder");
    }
    if (fs::is_directory(folder_ / file, error)) {
      throw OutputFailed("'" + (folder_ / file).string() +
                         "' is a folder where a file would go; choose another folder");
    }
  }
  Moves moves(stage_, folder_);
  try {
    for (const fs::path& file : files) moves.move(file);
  } catch (const fs::filesystem_error& problem) {
    moves.undo();
    throw OutputFailed("'" + folder_.string() + "' cannot be written: " + problem.code().message() +
                       "; nothing was changed, choose another folder");
  }
}

}  // namespace pneuma
