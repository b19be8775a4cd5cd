#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"

namespace pneuma {

/// The regular files in a folder, in the order of their names. Subfolders are not entered; what
/// cannot be looked at, such as a link to itself, is no file.
/// @throws InputMissing if the folder cannot be read
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder);

/// What in a folder is neither a file nor a folder: pipes, devices, links that lead nowhere.
/// Reading one tells what is wrong with it.
/// @throws InputMissing if the folder cannot be read
std::vector<std::filesystem::path> unreadableIn(const std::filesystem::path& folder);

/// The same as filesIn() with those in all folders below it; links to folders are not followed.
std::vector<std::filesystem::path> filesBelow(const std::filesystem::path& folder);

/// SHA-256 of a file of any size in hexadecimal, read piece by piece.
/// @throws InputMissing if it is missing, unreadable or a folder; Cancelled
std::string sha256OfFile(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace pneuma
