#include <cmath>
#include <sstream>

#include "core/error.h"
#include "io/detail/fissure_formats.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

/// The region may be a lobe beside the fissure: RIGHTLUNG, RightMiddleLobe.
std::optional<Fissure> fissureOfRow(const std::string& region, const std::string& type) {
  const bool right = region.starts_with("right");
  const bool left = region.starts_with("left");
  if (right && type == "horizontalfissure") return Fissure::RightHorizontal;
  if (right && type == "obliquefissure") return Fissure::RightOblique;
  if (left && type == "obliquefissure") return Fissure::LeftOblique;
  return std::nullopt;
}

}  // namespace

GivenFissures fissuresOfCipCsv(const std::filesystem::path& path, const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);  // the columns' names, which differ from file to file
  GivenFissures sets;
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    std::vector<std::string> fields;
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ',');) fields.emplace_back(trimmed(field));
    if (fields.empty() || (fields.size() == 1 && fields[0].empty())) continue;
    if (fields.size() != 5) {
      throw InvalidInput(quoted(path) + " has " + std::to_string(fields.size()) +
                         " fields in line " + std::to_string(number) +
                         "; region, type, x, y and z are needed");
    }
    const std::optional<Fissure> fissure = fissureOfRow(lowerCase(fields[0]), lowerCase(fields[1]));
    if (!fissure) continue;
    Vec3 place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::optional<double> value = parseDouble(fields[axis + 2]);
      if (!value || !std::isfinite(*value)) {
        throw InvalidInput(quoted(path) + " has no number in line " + std::to_string(number) +
                           ": '" + fields[axis + 2] + "'");
      }
      place[static_cast<Eigen::Index>(axis)] = *value;
    }
    sets[*fissure].points.push_back(place);
  }
  if (sets.empty()) throw InvalidInput(quoted(path) + " holds no points of fissures");
  return sets;
}

std::string cipCsvText(const GivenFissures& fissures) {
  std::string text = "Region,Type,X Location,Y Location,Z Location\n";
  for (const auto& [fissure, set] : fissures) {
    for (const Vec3& p : set.points) {
      text += side(fissure) == Side::Left ? "LEFTLUNG," : "RIGHTLUNG,";
      text += fissure == Fissure::RightHorizontal ? "HORIZONTALFISSURE" : "OBLIQUEFISSURE";
      for (const double coordinate : p) {
        text += ',';
        appendNumber(text, coordinate);
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace pneuma
