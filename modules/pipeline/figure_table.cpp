#include "pipeline/figure_table.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "pipeline/measure_report.h"

namespace pneuma {
namespace {

constexpr std::array Lines = std::to_array<FigureLine>({
    {"branches", "branches", 0},
    {"branches_contracted", "- one-daughter steps joined", 0},
    {"terminals", "terminals", 0},
    {"terminal_generation", "generation of terminals", 1},
    {"terminal_length_mm", "length of terminals, mm", 2},
    {"path_length_mm", "path from the root to terminal ends, mm", 1},
    {"branching_angle_deg", "branching angle, deg", 1},
    {"branching_angle_major_deg", "- of the major daughter", 1, false},
    {"branching_angle_minor_deg", "- of the minor daughter", 1, false},
    {"branching_angle_by_parent_diameter_deg/>4 mm", "- mother wider than 4 mm", 1, false},
    {"branching_angle_by_parent_diameter_deg/4-3 mm", "- mother 4-3 mm wide", 1, false},
    {"branching_angle_by_parent_diameter_deg/3-2 mm", "- mother 3-2 mm wide", 1, false},
    {"branching_angle_by_parent_diameter_deg/2-1 mm", "- mother 2-1 mm wide", 1, false},
    {"branching_angle_by_parent_diameter_deg/1-0.7 mm", "- mother 1-0.7 mm wide", 1, false},
    {"branching_angle_by_parent_diameter_deg/<0.7 mm", "- mother up to 0.7 mm wide", 1, false},
    {"rotation_angle_deg", "rotation angle, deg", 1},
    {"length_to_diameter", "length / diameter", 2},
    {"length_to_parent", "length / parent's length", 2},
    {"length_to_parent_below_one", "- share below 1", 2, false},
    {"diameter_to_parent", "diameter / parent's diameter", 3},
    {"diameter_minor_to_major", "minor / major daughter's diameter", 3},
    {"strahler/Rb", "Strahler branching ratio", 2},
    {"strahler/r2", "- R2", 3, false},
    {"strahler/Rl", "Strahler length ratio", 2},
    {"strahler/r2_length", "- R2", 3, false},
    {"strahler/Rd", "Strahler diameter ratio", 2},
    {"strahler/r2_diameter", "- R2", 3, false},
    {"horsfield/Rb", "Horsfield branching ratio", 2},
    {"horsfield/r2", "- R2", 3, false},
    {"horsfield/Rl", "Horsfield length ratio", 2},
    {"horsfield/r2_length", "- R2", 3, false},
    {"horsfield/Rd", "Horsfield diameter ratio", 2},
    {"horsfield/r2_diameter", "- R2", 3, false},
    {"dead_space_ml", "dead space, ml", 1},
    {"gap_mean", "gap to the nearest terminal, mean, spacings", 3},
    {"gap_p95", "- 95th percentile", 3},
    {"gap_max", "- largest", 3},
    {"spacing_mm", "- spacing, mm", 2},
    {"box_dimension/0/dimension", "box dimension, 2 to 4 mm", 2, false},
    {"box_dimension/1/dimension", "- 4 to 8 mm", 2, false},
    {"box_dimension/2/dimension", "- 8 to 16 mm", 2, false},
    {"box_dimension/3/dimension", "- 16 to 32 mm", 2, false},
    {"box_dimension/4/dimension", "- 32 to 64 mm", 2, false},
    {"crossings", "crossings of branches that are not kin", 0},
});

/// The numbers in `json`, their keys joined by dots; items of a list go by their place, 1, 2, ...
void appendFigures(const std::string& key, const Json& json, Figures& figures) {
  if (json.is_number()) figures.emplace_back(key, json.get<double>());
  const std::string prefix = key.empty() ? "" : key + ".";
  if (json.is_object()) {
    for (const auto& [name, member] : json.items()) appendFigures(prefix + name, member, figures);
  }
  if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      appendFigures(prefix + std::to_string(i + 1), json[i], figures);
    }
  }
}

/// Characters of a UTF-8 text: all bytes but those that continue one.
std::size_t lengthOf(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

Figures figuresOf(const Morphometry& morphometry) {
  Figures figures;
  appendFigures("", toJson(morphometry), figures);
  return figures;
}

std::string csvQuoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string csvBand(std::span<const PublishedBand> bands, std::string_view quantity) {
  const auto band = std::ranges::find(bands, quantity, &PublishedBand::quantity);
  if (band == bands.end()) return ",,";
  return textOf(band->low) + "," + textOf(band->high) + "," + csvQuoted(band->source);
}

std::span<const FigureLine> morphometryLines() { return Lines; }

Json figureAt(const Json& report, std::string_view key) {
  const Json::json_pointer place(std::string("/").append(key));
  return report.contains(place) ? report.at(place) : Json();
}

std::optional<double> meanOf(const Json& figure) {
  if (figure.is_number()) return figure.get<double>();
  if (figure.is_object() && figure.at("mean").is_number()) return figure.at("mean").get<double>();
  return std::nullopt;
}

std::optional<PublishedBand> bandOf(const FigureLine& line) {
  std::string quantity(line.key);
  std::ranges::replace(quantity, '/', '.');
  for (const PublishedBand& band : publishedBands()) {
    if (band.quantity == quantity || band.quantity == quantity + ".mean") return band;
  }
  return std::nullopt;
}

std::vector<std::string> bandText(const FigureLine& line) {
  const std::optional<PublishedBand> band = bandOf(line);
  if (!band.has_value()) return {};
  std::string text = textOf(band->low);
  if (band->high > band->low) text += " to " + textOf(band->high);
  return {text, std::string(band->source)};
}

std::string fixed(double value, int decimals) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  return buffer.data();
}

std::string textTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const std::vector<std::string>& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], lengthOf(row[k]));
  }
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      line += row[k] + std::string(widths[k] - lengthOf(row[k]) + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace pneuma
