#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "io/ct_file.h"
#include "io/json.h"
#include "pipeline/ct_model.h"

namespace pneuma::cli {

/// Adds --fix-tilt, --fill-gaps and --resample.
void addCorrections(CLI::App& app, CtCorrections& corrections);

/// The geometry card as JSON: size, spacing, tilt, gaps, HU, memory, all series of the place.
/// @param identifiers names of people and places go in as well
Json ctJson(const CtFile& file, bool identifiers);

/// The same for people.
std::string ctText(const CtFile& file, bool identifiers);

/// The table of series, best first, numbered as `--series` takes them.
std::string seriesTable(const std::vector<const DicomSeries*>& all);

}  // namespace pneuma::cli
