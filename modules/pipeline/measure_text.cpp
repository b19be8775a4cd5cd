#include <optional>
#include <string>
#include <vector>

#include "pipeline/figure_table.h"
#include "pipeline/measure_report.h"

namespace pneuma {
namespace {

using Row = std::vector<std::string>;

/// What a summary says beside its mean; "" for a single figure.
std::string spreadText(const Json& value, int decimals) {
  if (!value.is_object()) return "";
  const auto part = [&](const char* name) { return fixed(value.at(name).get<double>(), decimals); };
  return " +- " + part("sd") + " (" + part("min") + " to " + part("max") + ")";
}

std::string wholeTable(const Morphometry& whole) {
  const Json report = toJson(whole);
  std::vector<Row> rows = {{"quantity", "measured", "published", "source"}};
  for (const FigureLine& line : morphometryLines()) {
    const Json value = figureAt(report, line.key);
    const std::optional<double> mean = meanOf(value);
    if (!mean.has_value()) continue;
    Row row = {std::string(line.label),
               fixed(*mean, line.decimals) + spreadText(value, line.decimals)};
    for (std::string& column : bandText(line)) row.push_back(std::move(column));
    rows.push_back(std::move(row));
  }
  return textTable(rows);
}

std::string lobeTable(const std::map<Lobe, Morphometry>& byLobe) {
  std::vector<Json> reports;
  std::vector<Row> rows = {{"mean by lobe"}};
  for (const auto& [lobe, morphometry] : byLobe) {
    rows[0].emplace_back(shortName(lobe));
    reports.push_back(toJson(morphometry));
  }
  for (const FigureLine& line : morphometryLines()) {
    if (!line.byLobe) continue;
    Row row = {std::string(line.label)};
    bool known = false;
    for (const Json& report : reports) {
      const std::optional<double> mean = meanOf(figureAt(report, line.key));
      row.push_back(mean.has_value() ? fixed(*mean, line.decimals) : "-");
      known = known || mean.has_value();
    }
    if (known) rows.push_back(std::move(row));
  }
  return textTable(rows);
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
