#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"

namespace pneuma {

/// True if the name ends in .pneuma: a project, which is such an archive.
bool isProjectFileName(const std::filesystem::path& path);

/// A file inside an archive.
struct ArchiveMember {
  std::string name;     ///< with '/' between folders, such as "surfaces/RUL.ply"
  std::string content;  ///< its bytes
  bool packed = true;   ///< deflated; pictures are small already
};

/// What an archive may unpack to, at most.
struct ArchiveLimits {
  std::uint64_t bytes = std::uint64_t{1} << 36;  ///< of all members
  /// An archive may have this many times its own bytes, and freeSwelling bytes more: what swells
  /// beyond that is a bomb.
  std::uint64_t swelling = 200;
  std::uint64_t freeSwelling = std::uint64_t{768} << 20;
};

/// Writes a zip archive. It is written aside, synced and renamed, so that a file of this name is
/// the old one whole or the new one whole at any moment; what was there before is kept as
/// `path` with "~" behind it. Of members that would swell beyond the limits, images of nothing, as
/// many are left unpacked as that readArchive() takes it, the smallest first.
/// @throws OutputFailed naming the path and what to do; Cancelled: nothing is left behind
void writeArchive(const std::filesystem::path& path, const std::vector<ArchiveMember>& members,
                  const Progress& progress = {}, const ArchiveLimits& limits = {});

/// Reads the members of a zip archive, in their order. Their sizes are added up and compared with
/// the memory that there is before any is read; none may hold more than it states, lead out of the
/// archive, or be there twice, and all together may not have more than the limits say.
/// @throws InputMissing; InvalidInput (no archive, damaged, cut off, names that lead out, too
/// large); Unsupported (protected by a password); Error (OutOfMemory); Cancelled
std::vector<ArchiveMember> readArchive(const std::filesystem::path& path,
                                       const Progress& progress = {},
                                       const ArchiveLimits& limits = {});

}  // namespace pneuma
