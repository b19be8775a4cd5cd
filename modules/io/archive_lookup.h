#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/progress.h"

namespace pneuma {

/// Reads one member of a zip archive and unpacks no other; nothing if there is none of that name.
/// @param most bytes that it may have; more is InvalidInput
/// @throws InputMissing; InvalidInput (no archive; what stands before the member, or the member
/// itself, is damaged or leads out of the archive); Unsupported (protected by a password);
/// Cancelled
std::optional<std::string> readMember(const std::filesystem::path& path, const std::string& name,
                                      std::uint64_t most, const Progress& progress = {});

}  // namespace pneuma
