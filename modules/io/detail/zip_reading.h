#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <archive.h>
#include <archive_entry.h>

// What unpacking a zip archive to files and reading it into memory have in common.
namespace pneuma {

struct CloseArchive {
  void operator()(archive* handle) const { archive_read_free(handle); }
};

using Archive = std::unique_ptr<archive, CloseArchive>;

/// @throws Unsupported if it is protected by a password, std::bad_alloc where memory ended; else
/// InvalidInput
[[noreturn]] void throwDamagedArchive(const std::filesystem::path& path, archive* handle,
                                      const std::string& name);

/// @throws InputMissing; as throwDamagedArchive()
Archive openedArchive(const std::filesystem::path& path);

/// The next entry, nullptr at the end. @throws as throwDamagedArchive()
archive_entry* nextEntry(const std::filesystem::path& path, archive* handle);

/// @param number of the entry, for one without a name
std::string entryName(archive_entry* entry, std::size_t number);

bool isFileEntry(archive_entry* entry);

/// 0 where it is not stated, INT64_MAX at most.
std::uint64_t statedSize(archive_entry* entry);

/// @throws InvalidInput if the name leads out of the archive; Unsupported if the entry is encrypted
void requireHarmlessEntry(const std::filesystem::path& path, archive_entry* entry,
                          const std::string& name);

}  // namespace pneuma
