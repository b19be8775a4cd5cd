#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pneuma {

/// How arrays are stored in a VTK XML file that does not hold them as text.
struct VtkBlockEncoding {
  bool bigEndian = false;
  bool compressed = false;
  std::size_t wordSize = 4;  ///< bytes of a number in the header before the data
};

/// problemOfBlock() of an array that is not there, as that of an empty one may be.
inline constexpr const char* NoBlock = "has no data";

/// What is wrong with the array's bytes that `data` begins with, as the end of a sentence; "" if
/// its header agrees with the data that are there and with the `bytes` it must hold at least.
std::string problemOfBlock(std::string_view data, bool base64, const VtkBlockEncoding& encoding,
                           std::uint64_t bytes);

}  // namespace pneuma
