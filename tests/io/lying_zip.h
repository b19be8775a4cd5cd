#pragma once

#include <cstdint>
#include <string>

namespace pneuma::testing {

/// A number of `size` bytes, little endian.
inline std::string little(std::uint64_t number, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(number >> 8 * i & 0xFF);
  return bytes;
}

/// An archive of empty entries that say they unpack to `size` bytes each (zip64).
inline std::string lyingZip(int entries, std::uint64_t size) {
  std::string file;
  std::string directory;
  for (int i = 0; i < entries; ++i) {
    const std::string name = std::to_string(i) + ".dcm";
    const std::string extra = little(1, 2) + little(16, 2) + little(size, 8) + little(2, 8);
    // version, flags, deflate, time and date, CRC, both sizes in the extra field
    const std::string common = little(45, 2) + little(0, 2) + little(8, 2) + little(0, 4) +
                               little(0, 4) + little(0xFFFFFFFF, 4) + little(0xFFFFFFFF, 4) +
                               little(name.size(), 2) + little(extra.size(), 2);
    directory += "PK\1\2" + little(45, 2) + common + little(0, 2) + little(0, 2) + little(0, 2) +
                 little(0, 4) + little(file.size(), 4) + name + extra;
    file += "PK\3\4" + common + name + extra + std::string("\3\0", 2);
  }
  const auto count = static_cast<std::uint64_t>(entries);
  return file + directory + "PK\5\6" + little(0, 4) + little(count, 2) + little(count, 2) +
         little(directory.size(), 4) + little(file.size(), 4) + little(0, 2);
}

}  // namespace pneuma::testing
