#include "io/staged_folder.h"

#include <algorithm>
#include <new>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"
#include "core/memory_watch.h"
#include "io/atomic_file.h"
#include "io/detail/file_access.h"
#include "io/detail/input_file.h"
#include "io/unfinished_files.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr const char* OldOnes = ".replaced";

fs::path withoutSlash(fs::path folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

bool isThere(const fs::path& path) {
  return fs::symlink_status(path).type() != fs::file_type::not_found;
}

/// A folder of our own beside or in `folder`.
fs::path newStage(const fs::path& folder) {
  std::error_code error;
  const bool there = fs::is_directory(folder, error);
  if (!there && fs::exists(folder, error)) {
    throw OutputFailed("'" + folder.string() + "' is a file, not a folder; choose another name");
  }
  const fs::path parent = there ? folder : folder.parent_path();
  removeAbandoned(there ? folder : folderOf(folder));
  for (int n = 0; n < 100; ++n) {
    const fs::path stage = parent / nameAside(StageEnding);
    if (fs::create_directory(stage, error)) {
      // In a folder that is there, nobody else may enter it: files move out one by one. Else it
      // becomes the folder itself.
      const auto others = fs::perms::group_all | fs::perms::others_all;
      if (there) fs::permissions(stage, others, fs::perm_options::remove, error);
      return stage;
    }
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

/// Moves files one by one, and back again where one cannot be moved. At every moment, there is the
/// old file or the new one at each place.
class Moves {
 public:
  Moves(fs::path from, fs::path to) : from_(std::move(from)), to_(std::move(to)) {}

  void move(const fs::path& file) {
    const fs::path target = to_ / file;
    makeFolder(target.parent_path());
    const bool was = isThere(target);
    if (was) {
      keepOld(target, from_ / OldOnes / file);
      keepAccess(target, from_ / file);
    }
    done_.push_back({file, was});
    fs::rename(from_ / file, target);
    done_.back().moved = true;
  }

  /// After a power cut, too, the files are there.
  void sync() const {
    std::set<fs::path> folders;
    for (const Move& move : done_) folders.insert(folderOf(to_ / move.file));
    for (const fs::path& folder : made_) folders.insert(folderOf(folder));
    for (const fs::path& folder : folders) syncFolder(folder);
  }

  void undo() noexcept {
    std::error_code ignored;
    for (auto move = done_.rbegin(); move != done_.rend(); ++move) {
      if (!move->moved) continue;
      if (move->was) {
        fs::rename(from_ / OldOnes / move->file, to_ / move->file, ignored);
      } else {
        fs::remove(to_ / move->file, ignored);
      }
    }
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) {
      fs::remove(*folder, ignored);  // unless there is something in it
    }
  }

 private:
  struct Move {
    fs::path file;
    bool was = false;  ///< one was there before
    bool moved = false;
  };

  void makeFolder(const fs::path& folder) {
    if (folder.empty() || fs::is_directory(folder)) return;
    makeFolder(folder.parent_path());
    if (fs::create_directory(folder)) made_.push_back(folder);
  }

  /// A second name for it, and the first one stays.
  static void keepOld(const fs::path& file, const fs::path& kept) {
    fs::create_directories(kept.parent_path());
    std::error_code error;
    fs::create_hard_link(file, kept, error);
    if (!error) return;
    // Disks without hard links (FAT, some network disks), and others' files.
    fs::copy(file, kept, fs::copy_options::copy_symlinks);
  }

  /// Who may read the old one may read the new one, and nobody else.
  static void keepAccess(const fs::path& old, const fs::path& file) {
    struct stat status {};

    if (::stat(old.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
    const Descriptor written(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
    if (written.isOpen()) takeAccess(written.number(), status);
  }

  fs::path from_;
  fs::path to_;
  std::vector<Move> done_;
  std::vector<fs::path> made_;
};

}  // namespace

StagedFolder::StagedFolder(fs::path folder)
    : folder_(withoutSlash(std::move(folder))),
      stage_(newStage(folder_)),
      lock_(::open(stage_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)) {
  lockAside(lock_);
  noteUnfinished(stage_);
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;  // already an error on its way out, or nothing to remove
  fs::remove_all(stage_, ignored);
  forgetUnfinished(stage_);
  if (lock_ >= 0) ::close(lock_);
}

void StagedFolder::keep(Existing existing) {
  if (memoryRanOut()) throw std::bad_alloc();  // what was written may be half of it
  Moves moves(stage_, folder_);
  try {
    const std::vector<fs::path> files = filesUnder(stage_);
    std::error_code error;
    if (!fs::exists(folder_, error)) {
      const fs::path parent = folderOf(folder_);
      syncFolder(stage_);
      fs::rename(stage_, folder_, error);
      if (!error) return syncFolder(parent);
    }
    for (const fs::path& file : files) {
      if (existing == Existing::Refuse && isThere(folder_ / file)) {
        throw OutputFailed("'" + (folder_ / file).string() +
                           "' exists already; add --force to replace it, or choose another folder");
      }
      if (fs::is_directory(folder_ / file, error)) {
        throw OutputFailed("'" + (folder_ / file).string() +
                           "' is a folder where a file would go; choose another folder");
      }
    }
    for (const fs::path& file : files) moves.move(file);
    moves.sync();
  } catch (const fs::filesystem_error& problem) {
    moves.undo();
    throw OutputFailed("'" + folder_.string() + "' cannot be written: " + problem.code().message() +
                       "; nothing was changed, choose another folder");
  } catch (...) {
    moves.undo();
    throw;
  }
}

}  // namespace pneuma
