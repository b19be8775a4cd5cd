#pragma once

#include <filesystem>
#include <string>

namespace pneuma {

/// The PNG that a project shows itself by; nothing else of it is read. Empty if it holds none.
/// @throws InputMissing; InvalidInput (damaged, no project); Unsupported (by a password)
std::string projectThumbnail(const std::filesystem::path& path);

}  // namespace pneuma
