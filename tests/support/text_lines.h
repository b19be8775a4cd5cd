#pragma once

#include <sstream>
#include <string>

namespace pneuma::testing {

/// The first line of a text that begins with `start`; empty where none does.
inline std::string lineWith(const std::string& text, const std::string& start) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(start)) return line;
  }
  return "";
}

}  // namespace pneuma::testing
