#include "io/unfinished_files.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <mutex>
#include <new>
#include <random>
#include <set>
#include <system_error>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/detail/input_file.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view Beginning = ".pneuma-";
constexpr std::size_t Digits = 16;
constexpr std::time_t AbandonedAfterSeconds = 3600;

using PathText = std::array<char, PATH_MAX>;

/// Something that goes away if the program ends now. Texts of fixed length, so that they can be
/// read when memory is out; notes are used again and never freed, as others may read them then.
struct Note {
  PathText path{};    ///< empty: the note is free
  PathText before{};  ///< second name of the file that was there before, or empty
  bool ours = false;  ///< what is there now is of this process
  Note* next = nullptr;
};

struct Noted {
  std::mutex mutex;
  Note* first = nullptr;
};

/// Needs neither making nor destroying: a program may end while others still write.
constinit Noted noted;

bool fits(const fs::path& path) { return !path.empty() && path.native().size() < PATH_MAX; }

void put(PathText& text, const fs::path& path) {
  std::memcpy(text.data(), path.c_str(), path.native().size() + 1);
}

/// Null if there is none. The mutex is held.
Note* noteOf(std::string_view path) {
  Note* note = noted.first;
  while (note != nullptr && path != note->path.data()) note = note->next;
  return note;
}

/// Null if there is no memory for it. The mutex is held.
Note* newNote(const fs::path& path) {
  Note* note = noteOf("");
  if (note == nullptr) {
    note = new (std::nothrow) Note;
    if (note == nullptr) return nullptr;
    note->next = noted.first;
    noted.first = note;
  }
  note->before[0] = '\0';
  note->ours = false;
  put(note->path, path);
  return note;
}

/// A folder with nothing in it but files and folders like it.
void removeEverything(int parent, const char* name) noexcept {
  if (::unlinkat(parent, name, 0) == 0) return;
  const int folder = ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::fdopendir(folder), ::closedir);
  if (!entries) {
    ::close(folder);
    return;
  }
  while (const dirent* entry = ::readdir(entries.get())) {
    const std::string_view inside = entry->d_name;
    if (inside != "." && inside != "..") removeEverything(folder, entry->d_name);
  }
  ::unlinkat(parent, name, AT_REMOVEDIR);
}

bool isOld(const struct stat& status) {
  return status.st_uid == ::geteuid() &&
         status.st_mtime + AbandonedAfterSeconds < std::time(nullptr);
}

void removeIfAbandoned(int folder, const char* name) {
  struct stat named {};

  if (::fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) != 0 || !isOld(named)) return;
  if (!S_ISREG(named.st_mode) && !S_ISDIR(named.st_mode)) return;
  // Network disks (NFS) lock only what is open for writing.
  const auto open = [&](int way) {
    return ::openat(folder, name, way | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  };
  const int written = S_ISREG(named.st_mode) ? open(O_RDWR) : -1;
  const Descriptor file(written >= 0 ? written : open(O_RDONLY));

  struct stat opened {};

  if (!file.isOpen() || ::flock(file.number(), LOCK_EX | LOCK_NB) != 0) return;
  if (::fstat(file.number(), &opened) != 0 || opened.st_ino != named.st_ino ||
      opened.st_dev != named.st_dev) {
    return;
  }
  removeEverything(folder, name);
}

}  // namespace

void removeUnfinished() noexcept {
  // Whoever holds it may be the thread that has to end.
  const bool locked = noted.mutex.try_lock();
  for (const Note* note = noted.first; note != nullptr; note = note->next) {
    if (note->path[0] == '\0' || note->before[0] == '\0' || !note->ours) continue;
    ::rename(note->before.data(), note->path.data());
  }
  // Twice, for folders that have to be empty first. What is in others than those aside is not ours.
  for (int pass = 0; pass < 2; ++pass) {
    for (const Note* note = noted.first; note != nullptr; note = note->next) {
      if (note->path[0] == '\0' || note->before[0] != '\0') continue;
      const std::string_view name(note->path.data());
      if (isNameAside(name.substr(name.rfind('/') + 1))) {
        removeEverything(AT_FDCWD, note->path.data());
      } else if (note->ours && ::unlink(note->path.data()) != 0) {
        ::rmdir(note->path.data());
      }
    }
  }
  for (Note* note = noted.first; note != nullptr; note = note->next) note->path[0] = '\0';
  if (locked) noted.mutex.unlock();
}

void noteUnfinished(const fs::path& path) noexcept {
  if (!fits(path)) return;
  const std::lock_guard lock(noted.mutex);
  newNote(path);
}

bool noteReplaced(const fs::path& path, const fs::path& before) noexcept {
  if (!fits(path) || !fits(before)) return false;
  const std::lock_guard lock(noted.mutex);
  Note* note = newNote(path);
  if (note != nullptr) put(note->before, before);
  return note != nullptr;
}

void notePlaced(const fs::path& path) noexcept {
  const std::lock_guard lock(noted.mutex);
  if (Note* note = path.empty() ? nullptr : noteOf(path.native())) note->ours = true;
}

bool forgetUnfinished(const fs::path& path) noexcept {
  const std::lock_guard lock(noted.mutex);
  Note* note = path.empty() ? nullptr : noteOf(path.native());
  if (note == nullptr) return false;
  note->path[0] = '\0';
  return note->ours;
}

std::string nameAside(std::string_view ending) {
  std::random_device random;
  std::array<char, Digits + 1> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x%08x", random(), random());
  return std::string(Beginning).append(digits.data()).append(ending);
}

bool isNameAside(std::string_view name) {
  if (!name.starts_with(Beginning)) return false;
  name.remove_prefix(Beginning.size());
  const std::string_view ending = name.substr(std::min(Digits, name.size()));
  if (ending != PartEnding && ending != StageEnding) return false;
  return name.substr(0, Digits).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

void removeAbandoned(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> seen;
  {
    const std::lock_guard lock(mutex);
    if (!seen.insert(folder).second) return;
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(folder.c_str()), ::closedir);
  if (!entries) return;
  while (const dirent* entry = ::readdir(entries.get())) {
    if (isNameAside(entry->d_name)) removeIfAbandoned(::dirfd(entries.get()), entry->d_name);
  }
}

void leaveNoCoreDumps() noexcept {
  if (std::getenv("PNEUMA_CORE_DUMPS") != nullptr) return;
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
}

void lockAside(int number) noexcept { ::flock(number, LOCK_EX | LOCK_NB); }

}  // namespace pneuma
