#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pneuma {

/// Two hexadecimal digits for each byte.
inline std::string hexDigits(std::span<const unsigned char> bytes,
                             std::string_view digits = "0123456789abcdef") {
  std::string text;
  text.reserve(2 * bytes.size());
  for (const unsigned char byte : bytes) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

}  // namespace pneuma
