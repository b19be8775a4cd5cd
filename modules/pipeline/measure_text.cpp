#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/measure_report.h"

namespace pneuma {
namespace {

/// A line of the tables. `key` is the figure's place in the JSON report, levels joined by slashes.
struct Line {
  std::string_view key;
  std::string_view label;
  int decimals = 2;
  bool byLobe = true;  ///< also shown for every lobe
};

constexpr std::array Lines = std::to_array<Line>({
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

using Row = std::vector<std::string>;

/// Columns two spaces apart, flush left.
std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      line += row[k] + std::string(widths[k] - row[k].size() + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string fixed(double value, int decimals) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  return buffer.data();
}

/// The figure at `key`; null if there is none.
Json figure(const Json& report, std::string_view key) {
  const Json::json_pointer place(std::string("/").append(key));
  return report.contains(place) ? report.at(place) : Json();
}

/// A figure, or the mean of a summary; nothing if it is not known.
std::optional<double> meanOf(const Json& value) {
  if (value.is_number()) return value.get<double>();
  if (value.is_object() && value.at("mean").is_number()) return value.at("mean").get<double>();
  return std::nullopt;
}

/// What a summary says beside its mean; "" for a single figure.
std::string spreadText(const Json& value, int decimals) {
  if (!value.is_object()) return "";
  const auto part = [&](const char* name) { return fixed(value.at(name).get<double>(), decimals); };
  return " +- " + part("sd") + " (" + part("min") + " to " + part("max") + ")";
}

/// The published band of a figure or of its mean, and its source.
Row bandText(const Line& line) {
  std::string quantity(line.key);
  std::ranges::replace(quantity, '/', '.');
  for (const PublishedBand& band : publishedBands()) {
    if (band.quantity != quantity && band.quantity != quantity + ".mean") continue;
    std::string text = textOf(band.low);
    if (band.high > band.low) text += " to " + textOf(band.high);
    return {text, std::string(band.source)};
  }
  return {};
}

std::string wholeTable(const Morphometry& whole) {
  const Json report = toJson(whole);
  std::vector<Row> rows = {{"quantity", "measured", "published", "source"}};
  for (const Line& line : Lines) {
    const Json value = figure(report, line.key);
    const std::optional<double> mean = meanOf(value);
    if (!mean.has_value()) continue;
    Row row = {std::string(line.label),
               fixed(*mean, line.decimals) + spreadText(value, line.decimals)};
    for (std::string& column : bandText(line)) row.push_back(std::move(column));
    rows.push_back(std::move(row));
  }
  return table(rows);
}

std::string lobeTable(const std::map<Lobe, Morphometry>& byLobe) {
  std::vector<Json> reports;
  std::vector<Row> rows = {{"mean by lobe"}};
  for (const auto& [lobe, morphometry] : byLobe) {
    rows[0].emplace_back(shortName(lobe));
    reports.push_back(toJson(morphometry));
  }
  for (const Line& line : Lines) {
    if (!line.byLobe) continue;
    Row row = {std::string(line.label)};
    bool known = false;
    for (const Json& report : reports) {
      const std::optional<double> mean = meanOf(figure(report, line.key));
      row.push_back(mean.has_value() ? fixed(*mean, line.decimals) : "-");
      known = known || mean.has_value();
    }
    if (known) rows.push_back(std::move(row));
  }
  return table(rows);
}

}  // namespace

std::string measureText(const Morphometry& whole, const std::map<Lobe, Morphometry>& byLobe) {
  std::string text = wholeTable(whole) +
                     "Summaries are mean +- sd (min to max). Published figures are those of both "
                     "lungs of an adult.\n";
  if (byLobe.size() > 1) text.append("\n").append(lobeTable(byLobe));
  return text;
}

}  // namespace pneuma
