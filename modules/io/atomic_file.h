#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace pneuma {

/// What to do if the output is there already.
enum class Existing { Refuse, Replace };

/// Throws now if `path` could not be written later: before long work, not after it.
/// @throws OutputFailed naming the path and what to do (exists, no folder, read-only, a folder)
void requireWritable(const std::filesystem::path& path, Existing existing = Existing::Replace);

/// The folder that a path stands in, as it is written; "." if it names none.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// Asks the system to keep the names in a folder, so that they are there after a power cut. Some
/// file systems cannot; what is in the files is safe without.
void syncFolder(const std::filesystem::path& folder) noexcept;

/// A folder and those that it stands in, where they are not there. @throws OutputFailed
void makeFolder(const std::filesystem::path& folder);

/// The file that a path stands for: itself, or the end of its links, which need not be there. A
/// link again if they lead to themselves.
std::filesystem::path endOfLinks(const std::filesystem::path& path);

/// A file that is written piece by piece beside its target. It takes the target's place when it is
/// whole, and goes away if that never happens.
class AtomicFile {
 public:
  /// @throws OutputFailed naming the path and what to do, as requireWritable()
  explicit AtomicFile(const std::filesystem::path& path, Existing existing = Existing::Replace);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends. @throws OutputFailed
  void write(std::string_view content);

  /// Replaces bytes written before, from `offset` on. @throws OutputFailed
  void overwrite(std::uint64_t offset, std::string_view content);

  /// Syncs, takes the target's place and syncs the folder; nothing may follow. @throws OutputFailed
  void commit();

 private:
  std::filesystem::path target_;  ///< what a symbolic link stands for, so that the link survives
  std::filesystem::path part_;    ///< empty once it has become the target
  Existing existing_;
  int number_ = -1;
};

/// Writes a file aside, syncs it and renames it: the old file whole or the new one whole.
/// @throws OutputFailed naming the path and the reason; nothing is left behind
void writeFile(const std::filesystem::path& path, std::string_view content,
               Existing existing = Existing::Replace);

/// The whole content of a file.
/// @throws InputMissing if it is missing, unreadable or a folder; InvalidInput if larger than
/// `limit`
std::string readFile(const std::filesystem::path& path, std::size_t limit = std::size_t{4} << 30);

/// SHA-256 in hexadecimal.
std::string sha256(std::string_view content);

}  // namespace pneuma
