#pragma once

#include <string>
#include <vector>

namespace pneuma::cli {

/// What a completion script has to know about one option or positional argument.
struct CompletedOption {
  std::vector<std::string> longNames;   ///< without dashes
  std::vector<std::string> shortNames;  ///< without the dash
  std::string help;
  std::vector<std::string> choices;  ///< the values there are; empty if open
  bool positional = false;
  bool takesValue = false;
  bool isFile = false;
  bool isFolder = false;
};

struct CompletedCommand {
  std::string name;
  std::string summary;
  std::vector<CompletedOption> options;
};

std::string bashCompletion(const std::vector<CompletedCommand>& commands);
std::string zshCompletion(const std::vector<CompletedCommand>& commands);
std::string fishCompletion(const std::vector<CompletedCommand>& commands);

}  // namespace pneuma::cli
