#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pneuma {

/// What to do if the output is there already.
enum class Existing { Refuse, Replace };

/// Throws now if `path` could not be written later: before long work, not after it.
/// @throws OutputFailed naming the path and what to do (exists, no folder, read-only, a folder)
void requireWritable(const std::filesystem::path& path, Existing existing = Existing::Replace);

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
