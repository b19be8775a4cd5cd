#pragma once

#include <string>
#include <string_view>

namespace pneuma {

/// Text as it stands in XML and HTML, between tags or in a quoted attribute.
inline std::string markupEscaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace pneuma
