#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "anatomy/predefined_airways.h"

namespace pneuma {

/// Reads a table of predefined airways (docs/airway-table.md): JSON with `schema`
/// "pneuma/airway-table/1". Bifurcations may stand in any order; they come back parents first.
/// Every airway that is not divided must carry the name of a segment (anatomy/segment.h).
/// @param name of the text, for errors
/// @throws InvalidInput naming the entry: no JSON, a member missing or of another kind, a value out
///         of range, an airway named or divided twice, an unknown parent, a cycle, an unknown
///         segment
PredefinedAirways airwayTableOf(std::string_view text, const std::string& name);

/// @throws InputMissing; InvalidInput as airwayTableOf()
PredefinedAirways readAirwayTable(const std::filesystem::path& path);

/// The table as text that airwayTableOf() reads back.
std::string airwayTableText(const PredefinedAirways& table);

/// The table of the thorax that comes with the program (resources/airways/thorax.json), for its
/// size of 6,388 ml.
PredefinedAirways thoraxAirways();

}  // namespace pneuma
