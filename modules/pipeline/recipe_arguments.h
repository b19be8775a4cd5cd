#pragma once

#include <string>
#include <vector>

#include "pipeline/recipe.h"

namespace pneuma {

/// What a recipe asks of a command, as that command takes it: the options that differ from the
/// defaults, each as a word of its own ("--threshold=-600"). Inputs and outputs are not among them.
/// Paths are absolute.
std::vector<std::string> infoArguments(const Recipe& recipe);     ///< `pneuma info`
std::vector<std::string> importArguments(const Recipe& recipe);   ///< `pneuma import`
std::vector<std::string> segmentArguments(const Recipe& recipe);  ///< of a CT that was imported
std::vector<std::string> lobesArguments(const Recipe& recipe);    ///< `pneuma lobes`, the same
std::vector<std::string> growArguments(const GrowthOptions& options);  ///< without --method

}  // namespace pneuma
