#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/fissure_file.h"
#include "io/json.h"

/// One format of fissure files each: reading takes the file's content, its path only for messages.
namespace pneuma {

/// The fissure that a label speaks of: its short or long name, "major" for oblique and "minor" for
/// horizontal, or RO, RH, LO; in any case, with blanks, dashes or underscores between words, a
/// number behind it or not ("right-oblique-3", "Right Minor Fissure", "RO12").
std::optional<Fissure> fissureOfLabel(std::string_view label);

/// What labels may say, for messages.
std::string labelAdvice();

/// Our own, "pneuma/fissures/1"; surfaces are read from their files, whose names count from the
/// path's folder. Text has them as they count from `folder`.
FissureFile fissuresOfJson(const std::filesystem::path& path, const Json& json);
std::string fissureJsonText(const FissureFile& file, const std::filesystem::path& folder);

/// Markups of 3D Slicer (markups-schema-v1.0).
bool isMarkups(const Json& json);
GivenFissures fissuresOfMarkups(const std::filesystem::path& path, const Json& json);
std::string markupsText(const GivenFissures& fissures);

/// Markups of 3D Slicer in its older format.
GivenFissures fissuresOfFcsv(const std::filesystem::path& path, const std::string& text);
std::string fcsvText(const GivenFissures& fissures);

/// The Chest Imaging Platform's points.
GivenFissures fissuresOfCipCsv(const std::filesystem::path& path, const std::string& text);
std::string cipCsvText(const GivenFissures& fissures);

}  // namespace pneuma
