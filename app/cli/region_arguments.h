#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "io/json.h"
#include "pipeline/organs.h"

namespace pneuma::cli {

/// What trees are measured against: the arguments that all commands share that measure.
struct RegionArguments {
  std::vector<std::filesystem::path> domain;
  std::string organ;
  OrganOptions organOptions;
  std::uint64_t seed = 1;

  static constexpr auto fields() {
    return std::tuple{Field{"seed", &RegionArguments::seed, "", Range{0, 9007199254740991.0},
                            "Seed of the random points of the gap."}};
  }
};

/// Adds --domain, --organ, --organ-size and --seed.
void addRegionArguments(CLI::App& app, RegionArguments& arguments);

/// @throws InvalidOption unless there is one region to measure in, or none
/// @param command for the message
void requireOneRegion(const RegionArguments& arguments, const std::string& command);

/// The "parameters" of a report.
Json parametersOf(const RegionArguments& arguments);

/// The lobes or the organ with their regions; an empty model where none was asked for.
/// @throws InvalidInput for a surface that is not closed; as openLobes(), openOrgan()
LungModel opened(const RegionArguments& arguments, const Progress& progress);

}  // namespace pneuma::cli
