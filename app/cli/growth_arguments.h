#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "pipeline/organs.h"
#include "pipeline/variation.h"

namespace pneuma::cli {

/// What is grown in, from, by which method and with which options: the arguments that all commands
/// share that grow.
struct GrowthArguments {
  std::vector<std::filesystem::path> lobes;
  std::string organ;
  OrganOptions organOptions;
  std::filesystem::path central;
  std::string method{growthMethods().front().name};
  std::vector<std::string> assignments;
  std::vector<std::string> shortcuts;  ///< options of the method under names of their own
  std::vector<std::string> variation;  ///< assignments to VariationOptions
};

/// Adds LOBES, --organ, --organ-size, --airway-table, --central, --method, --set, --terminals and
/// --vary.
void addGrowthArguments(CLI::App& app, GrowthArguments& arguments);

/// `--name N` for the method's own option `name`.
void addShortcut(CLI::App& app, GrowthArguments& arguments, const std::string& name,
                 const std::string& help);

/// The options of every method and of --vary, for a help page.
std::string growthOptionsHelp();

/// @throws InvalidOption unless there is exactly one thing to grow in
/// @param command for the message
void requireOneOrgan(const GrowthArguments& arguments, const std::string& command);

/// @throws InvalidOption
GrowthOptions growthOptions(const GrowthArguments& arguments);
VariationOptions variationOptions(const GrowthArguments& arguments);

/// Reads what is to be grown in and from. @throws as openLobes(), openOrgan(), withCentral()
LungModel opened(const GrowthArguments& arguments, const Progress& progress);

}  // namespace pneuma::cli
