#include "io/detail/unzipped.h"

#include <algorithm>
#include <array>
#include <fstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"
#include "io/detail/text_fields.h"
#include "io/detail/zip_reading.h"
#include "io/unfinished_files.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t MostFiles = 20000;
// CT slices shrink to a half or a third, empty ones to a hundredth; a bomb to a thousandth.
constexpr std::uint64_t MostSwelling = 200;
constexpr std::uint64_t FreeSwelling = std::uint64_t{64} << 20;
constexpr std::size_t BlockSize = std::size_t{1} << 18;

/// The end of an archive's name that may go into a name of our own: none rather than a long one,
/// which the disk may not take.
std::string extensionOf(const std::string& name) {
  constexpr std::size_t Longest = 16;
  std::string extension = fs::path(name).extension().string();
  return extension.size() <= Longest ? extension : "";
}

/// The folder for temporary files. @throws OutputFailed if there is none
fs::path temporaryFolder() {
  std::error_code error;
  fs::path folder = fs::temp_directory_path(error);
  if (error) {
    throw OutputFailed(
        "there is no folder for temporary files to unpack an archive into; set TMPDIR to one that "
        "exists");
  }
  return folder;
}

/// Bytes that an archive may swell to.
std::uint64_t mostBytes(const fs::path& path) {
  std::error_code error;
  const std::uint64_t packed = fs::file_size(path, error);
  if (error) {
    throw InputMissing("the archive " + quoted(path) + " cannot be read: " + error.message());
  }
  return FreeSwelling + MostSwelling * packed;
}

[[noreturn]] void throwSwollen(const fs::path& path, std::uint64_t total) {
  throw InvalidInput("the archive " + quoted(path) + " would swell to " +
                     std::to_string(total >> 20) +
                     " MB or more, which no CT does; it was not unpacked");
}

/// Refuses what should not be unpacked, before a byte is.
void requireHarmless(const fs::path& path, const Progress& progress) {
  const Archive handle = openedArchive(path);
  const std::uint64_t most = mostBytes(path);
  std::uint64_t total = 0;
  std::size_t count = 0;
  while (archive_entry* entry = nextEntry(path, handle.get())) {
    progress.throwIfStopped();
    const std::string name = entryName(entry, ++count);
    requireHarmlessEntry(path, entry, name);
    if (isFileEntry(entry)) total += statedSize(entry);
    // At every entry, so that no sum of sizes is too large for its type.
    if (total > most) throwSwollen(path, total);
    if (count > MostFiles) {
      throw InvalidInput("the archive " + quoted(path) + " holds more than " +
                         std::to_string(MostFiles) + " entries; unpack it first");
    }
  }
  std::error_code error;
  const fs::space_info space = fs::space(temporaryFolder(), error);
  if (!error && total > space.available) {
    throw OutputFailed("unpacking " + quoted(path) + " takes " + std::to_string(total >> 20) +
                       " MB in the temporary folder, where " +
                       std::to_string(space.available >> 20) + " MB are free; unpack it elsewhere");
  }
}

/// A new folder that only this user may enter; goes away with this, and with the next one an hour
/// later if this process is killed.
class PrivateFolder {
 public:
  PrivateFolder() {
    const fs::path parent = temporaryFolder();
    removeAbandoned(parent);
    path_ = parent / nameAside(StageEnding);
    noteUnfinished(path_);
    if (::mkdir(path_.c_str(), 0700) != 0) {
      forgetUnfinished(path_);
      throw OutputFailed("no folder can be made in " + quoted(parent) +
                         " to unpack into; is the disk full?");
    }
    lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (lock_ >= 0) lockAside(lock_);
  }

  ~PrivateFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    forgetUnfinished(path_);
    if (lock_ >= 0) ::close(lock_);
  }

  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  int lock_ = -1;  ///< tells others that it is not abandoned
};

/// Returns the bytes written. @param room bytes that the archive may still swell by
std::uint64_t unpackEntry(const fs::path& path, archive* handle, archive_entry* entry,
                          const std::string& name, const fs::path& target, std::uint64_t room,
                          const Progress& progress) {
  std::ofstream file(target, std::ios::binary);
  std::array<char, BlockSize / 4> block{};
  std::uint64_t written = 0;
  const std::uint64_t stated = statedSize(entry);
  while (true) {
    const la_ssize_t size = archive_read_data(handle, block.data(), block.size());
    if (size < 0) throwDamagedArchive(path, handle, name);
    if (size == 0) break;
    progress.throwIfStopped();
    written += static_cast<std::uint64_t>(size);
    if (written > stated) {
      throw InvalidInput("the archive " + quoted(path) + " states " + std::to_string(stated) +
                         " bytes for " + quotedName(name) + " but holds more; it is damaged");
    }
    // Once more: the file may have changed since its sizes were added up.
    if (written > room) throwSwollen(path, written);
    file.write(block.data(), size);
  }
  if (!file.flush()) {
    throw OutputFailed("the temporary folder cannot hold " + quotedName(name) +
                       "; is the disk full?");
  }
  return written;
}

}  // namespace

bool isZipFile(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;  // opening a pipe would wait
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> start{};
  file.read(start.data(), start.size());
  const std::string_view magic(start.data(), start.size());
  using namespace std::string_view_literals;
  return file && (magic == "PK\3\4"sv || magic == "PK\5\6"sv);
}

Unzipped unzipped(const fs::path& archive, const Progress& progress) {
  requireHarmless(archive, progress);
  const auto folder = std::make_shared<const PrivateFolder>();
  Unzipped result;
  result.folder = folder;
  const Archive handle = openedArchive(archive);
  std::uint64_t room = mostBytes(archive);
  std::size_t count = 0;
  while (archive_entry* entry = nextEntry(archive, handle.get())) {
    const std::string name = entryName(entry, ++count);
    if (!isFileEntry(entry)) continue;
    // Names of our own: those of the archive may clash, or mean something to the file system.
    const fs::path target = folder->path() / (std::to_string(count) + extensionOf(name));
    room -= unpackEntry(archive, handle.get(), entry, name, target, room, progress);
    result.files.push_back({target, fs::path(name).filename().string()});
  }
  std::ranges::sort(result.files, {}, &Unzipped::File::name);
  return result;
}

}  // namespace pneuma
