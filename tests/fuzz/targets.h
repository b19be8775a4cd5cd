#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace pneuma::fuzz {

/// A reader that is given any bytes as a file.
struct Target {
  std::string name;
  std::string file;  ///< what the file is called; readers go by its ending
  std::function<void(const std::filesystem::path&)> read;
};

/// One for every format that is read.
const std::vector<Target>& targets();

/// Writes the bytes as the target's file into the folder and reads it. Returns if it was read, or
/// refused as documented.
/// @throws whatever else the reader throws, which is a fault
void tryBytes(const Target& target, const std::filesystem::path& folder,
              std::span<const std::uint8_t> bytes);

}  // namespace pneuma::fuzz
