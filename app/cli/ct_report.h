#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "io/ct_file.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma::cli {

/// Adds --fix-tilt, --fill-gaps and --resample.
void addCorrections(CLI::App& app, CtCorrections& corrections);

/// What was read, for a report: a file's hash, or one over the hashes of a series' files in the
/// order of its slices. Every byte is read once more. @throws InputMissing, Cancelled
InputFile ctInput(const std::filesystem::path& path, const CtFile& file,
                  const Progress& progress = {});

/// The geometry card as JSON: size, spacing, tilt, gaps, HU, memory, all series of the place.
/// @param identifiers names of people and places go in as well
Json ctJson(const CtFile& file, bool identifiers);

/// The same for people.
std::string ctText(const CtFile& file, bool identifiers);

/// The table of series, best first, numbered as `--series` takes them.
std::string seriesTable(const std::vector<const DicomSeries*>& all);

}  // namespace pneuma::cli
