#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pneuma {

/// One file of several that are opened together.
struct Block {
  std::string name;
  std::filesystem::path file;  ///< relative to the folder of the .vtm
};

/// Writes a VTK multi-block file (.vtm) that names others: ParaView opens all of them with it.
/// @throws OutputFailed
void writeMultiblock(const std::filesystem::path& path, const std::vector<Block>& blocks);

}  // namespace pneuma
