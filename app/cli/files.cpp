#include "cli/files.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/input_files.h"
#include "io/piece_files.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/unfinished_files.h"
#include "io/volume_file.h"

namespace pneuma::cli {
namespace {

namespace fs = std::filesystem;

std::string lowerExtension(const fs::path& path) {
  std::string text = path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

[[noreturn]] void throwExtension(const fs::path& path, const std::string& what,
                                 const std::string& extensions) {
  throw Unsupported("'" + path.string() + "' cannot be written: " + what + " go to " + extensions +
                    " files");
}

}  // namespace

std::vector<fs::path> modelsIn(const fs::path& folder) {
  std::vector<fs::path> inside = filesIn(folder);
  // A model's name on what is no file, such as a link that leads nowhere: reading it says so.
  for (const fs::path& path : unreadableIn(folder)) {
    if (isSurfaceFileName(path)) inside.push_back(path);
  }
  std::sort(inside.begin(), inside.end());
  std::erase_if(inside,
                [](const fs::path& file) { return !isSurfaceFileName(file) && !isTreeFile(file); });
  return inside;
}

std::vector<fs::path> expanded(std::span<const fs::path> paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    requireWhole(path);
    const std::vector<fs::path> inside = modelsIn(path);
    if (inside.empty()) {
      throw InputMissing("the folder '" + path.string() +
                         "' holds no surface and no tree; name the files themselves");
    }
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

bool isTreeFileName(const fs::path& path) {
  static constexpr std::array<std::string_view, 5> Extensions = {".vtp", ".vtu", ".swc", ".csv",
                                                                 ".json"};
  return std::find(Extensions.begin(), Extensions.end(), lowerExtension(path)) != Extensions.end();
}

void requireOutput(const fs::path& path, Existing existing) {
  std::error_code error;
  if (existing == Existing::Refuse && fs::is_regular_file(path, error)) {
    throw OutputFailed("'" + path.string() +
                       "' exists already; add --force to replace it, or choose another name");
  }
  requireWritable(path, existing);
}

void requireVolumeOutput(const fs::path& path, Existing existing) {
  // Headers with their voxels in a second file are read, but not written.
  const std::string extension = lowerExtension(path);
  if (!isVolumeFileName(path) || extension == ".mhd" || extension == ".nhdr") {
    throwExtension(path, "CTs and labels", ".nii.gz, .nii, .nrrd or .mha");
  }
  requireOutput(path, existing);
}

void requireTreeOutput(const fs::path& path, Existing existing) {
  if (!isTreeFileName(path) || lowerExtension(path) == ".vtu") {
    throwExtension(path, "trees", ".vtp, .swc, .csv or .json");
  }
  requireOutput(path, existing);
}

void requireSurfaceOutput(const fs::path& path, Existing existing) {
  if (!isSurfaceFileName(path)) throwExtension(path, "surfaces", ".stl, .ply, .obj or .vtp");
  requireOutput(path, existing);
}

void requirePngOutput(const fs::path& path, Existing existing) {
  if (lowerExtension(path) != ".png") throwExtension(path, "pictures", ".png");
  requireOutput(path, existing);
}

void requireFolderOutput(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  if (fs::exists(folder, error)) {
    throw OutputFailed("'" + folder.string() + "' is a file, not a folder; choose another name");
  }
  // A folder can be made where a file could.
  requireWritable(folder.has_filename() ? folder : folder.parent_path());
}

void requireOtherThanInputs(const fs::path& output, std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    std::error_code error;
    if (fs::equivalent(output, input, error)) {
      throw InvalidOption("the output '" + output.string() +
                          "' is the same file as the input; choose another name");
    }
  }
}

OutputSet::Aside::Aside(const fs::path& folder) : path_(folder / nameAside(StageEnding)) {
  noteUnfinished(path_);
  std::error_code ignored;  // then files are replaced for good
  fs::create_directory(path_, ignored);
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock_ >= 0) lockAside(lock_);
}

OutputSet::Aside::~Aside() {
  std::error_code ignored;
  for (const Kept& kept : files_) {
    if (kept.noted) forgetUnfinished(kept.file);
  }
  fs::remove_all(path_, ignored);
  forgetUnfinished(path_);
  if (lock_ >= 0) ::close(lock_);
}

void OutputSet::Aside::keep(const fs::path& file) {
  const fs::path second = path_ / std::to_string(files_.size());
  std::error_code error;  // disks without hard links: then it is replaced for good
  fs::create_hard_link(file, second, error);
  if (!error) files_.push_back({file, second, noteReplaced(file, second)});
}

void OutputSet::Aside::bringBack() {
  std::error_code ignored;
  for (auto kept = files_.rbegin(); kept != files_.rend(); ++kept) {
    // What another program has put there meanwhile stays.
    const bool ours = !kept->noted || forgetUnfinished(kept->file);
    kept->noted = false;
    if (ours) fs::rename(kept->second, kept->file, ignored);
  }
}

OutputSet::~OutputSet() {
  for (auto& [folder, aside] : replaced_) aside.bringBack();
  for (auto path = added_.rbegin(); path != added_.rend(); ++path) {
    std::error_code ignored;  // already an error on its way out, or nothing to remove
    // What another program has put there meanwhile stays.
    if (forgetUnfinished(*path)) fs::remove(*path, ignored);
  }
}

void OutputSet::add(const fs::path& path, const fs::path& aside) {
  std::error_code error;
  const fs::path file = endOfLinks(path);
  if (fs::is_symlink(file, error)) return;  // one that leads to itself: the writer says so
  if (fs::exists(file, error)) {
    if (!fs::is_regular_file(file, error)) return;
    const fs::path folder = aside.empty() ? file.parent_path() : aside;
    replaced_.try_emplace(folder, folder).first->second.keep(file);
    return;
  }
  added_.push_back(file);
  noteUnfinished(file);
}

void OutputSet::keep() {
  for (const fs::path& path : added_) forgetUnfinished(path);
  added_.clear();
  replaced_.clear();
}

void OutputSet::addFolder(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return;
  if (!fs::create_directory(path, error)) {
    throw OutputFailed("the folder '" + path.string() + "' cannot be made" +
                       (error ? ": " + error.message() : std::string()) +
                       "; make its parent first or choose another");
  }
  syncFolder(folderOf(path));
  added_.push_back(path);
  noteUnfinished(path);
  notePlaced(path);
}

}  // namespace pneuma::cli
