#include <algorithm>
#include <array>
#include <cstdio>

#include "pipeline/measure_report.h"
#include "pipeline/report.h"
#include "pipeline/study.h"

namespace pneuma {
namespace {

/// A column of the table of seeds: a quantity and its heading. The others stand only in the table
/// of means.
struct Column {
  std::string_view name;
  std::string_view heading;
  int decimals;
  int width;
};

constexpr std::array Columns = std::to_array<Column>({
    {"N", "N", 0, 8},
    {"T", "T", 0, 8},
    {"Q_f", "Q_f", 4, 8},
    {"C_n", "C_n", 3, 7},
    {"C_a", "C_a", 3, 7},
    {"V_r", "V_r", 4, 8},
    {"EL", "EL", 4, 8},
    {"PI", "PI", 3, 7},
    {"generation", "generation", 2, 11},
    {"terminal_diameter_mm", "diameter", 3, 9},
    {"path_length_mm", "path", 1, 7},
});

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 128> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

std::optional<double> figure(const StudyRow& row, std::string_view name) {
  const auto found = std::ranges::find_if(
      row.figures, [&](const auto& candidate) { return candidate.first == name; });
  if (found == row.figures.end()) return std::nullopt;
  return found->second;
}

std::string seedTable(const Study& study) {
  std::string text = formatted("%-8s", "seed");
  for (const Column& column : Columns) {
    text += formatted("%*s", column.width, std::string(column.heading).c_str());
  }
  text += "\n";
  for (const StudyRow& row : study.rows) {
    text += formatted("%-8s", std::to_string(row.seed).c_str());
    for (const Column& column : Columns) {
      const std::optional<double> value = figure(row, column.name);
      text += value.has_value() ? formatted("%*.*f", column.width, column.decimals, *value)
                                : formatted("%*s", column.width, "-");
    }
    text += "\n";
  }
  return text;
}

std::string meanTable(const Study& study) {
  std::string text =
      formatted("%-28s %12s %12s %12s %12s\n", "quantity", "mean", "SD", "min", "max");
  for (const StudyQuantity& quantity : study.quantities) {
    const Summary& s = quantity.summary;
    text += formatted("%-28s %12.6g %12.4g %12.6g %12.6g\n", quantity.name.c_str(), s.mean, s.sd,
                      s.min, s.max);
  }
  return text;
}

}  // namespace

Json toJson(const Study& study, const LungModel& model) {
  Json options = std::visit([](const auto& o) { return toJson(o); }, study.options);
  options.erase("seed");
  Json variation = toJson(study.variation);
  Json parameters = {{"options", options}, {"variation", variation}};
  Json json = reportEnvelope("pneuma/study/1", model.inputs, std::move(parameters),
                             study.rows.front().seed);
  for (const std::string& warning : model.warnings) json["warnings"].push_back(warning);
  for (const std::string& warning : study.warnings) json["warnings"].push_back(warning);
  json["method"] = growthMethod(study.options).name;
  json["options"] = std::move(options);
  json["variation"] = std::move(variation);
  json["rows"] = Json::array();
  for (const StudyRow& row : study.rows) {
    Json figures = Json::object();
    for (const auto& [name, value] : row.figures) figures[name] = value;
    json["rows"].push_back({{"seed", row.seed}, {"figures", std::move(figures)}});
  }
  json["quantities"] = Json::object();
  for (const StudyQuantity& quantity : study.quantities) {
    json["quantities"][quantity.name] = toJson(quantity.summary);
  }
  return json;
}

std::string studyText(const Study& study) {
  return seedTable(study) + "\n" + meanTable(study) +
         "Means of the terminals: generation, diameter (mm), path from the root (mm). Names that "
         "end in _today: definitions of today, not of Kitaoka 1999.\n";
}

std::string studyCsv(const Study& study) {
  std::string csv = "seed";
  for (const StudyQuantity& quantity : study.quantities) csv.append(",").append(quantity.name);
  csv += '\n';
  for (const StudyRow& row : study.rows) {
    csv += std::to_string(row.seed);
    for (const StudyQuantity& quantity : study.quantities) {
      const std::optional<double> value = figure(row, quantity.name);
      csv += ',';
      if (value.has_value()) csv += textOf(*value);
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace pneuma
