#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "pipeline/report.h"
#include "pipeline/reproduce.h"

namespace pneuma {
namespace {

std::string_view nameOf(Limit::Of of) {
  switch (of) {
    case Limit::Of::Relative:
      return "relative";
    case Limit::Of::Difference:
      return "difference";
    case Limit::Of::Range:
      return "range";
    case Limit::Of::Nothing:
      break;
  }
  return "nothing";
}

Json limitJson(const Limit& limit) {
  switch (limit.of) {
    case Limit::Of::Range:
      return {limit.low, limit.high};
    case Limit::Of::Nothing:
      return nullptr;
    default:
      return limit.most;
  }
}

Json rowJson(const ReproducedRow& row) {
  Json json = {{"row", row.row},
               {"quantity", row.quantity},
               {"limit", limitJson(row.limit)},
               {"limit_of", nameOf(row.limit.of)},
               {"ok", row.ok()}};
  if (!std::isnan(row.measured)) json["measured"] = row.measured;
  if (row.isPublished()) {
    json["published"] = row.published;
    if (!std::isnan(row.measured)) json["relative"] = row.relative();
  }
  if (row.sd) json["sd"] = *row.sd;
  if (!row.note.empty()) json["note"] = row.note;
  return json;
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 200> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// Counts whole, everything else to four digits.
std::string figureText(double value) {
  if (std::isnan(value)) return "-";
  return formatted(std::abs(value) >= 1000.0 ? "%.0f" : "%.4g", value);
}

std::string limitText(const Limit& limit) {
  switch (limit.of) {
    case Limit::Of::Relative:
      return formatted("%.3g %%", 100.0 * limit.most);
    case Limit::Of::Difference:
      return formatted("%.3g", limit.most);
    case Limit::Of::Range:
      return formatted("%.4g to %.4g", limit.low, limit.high);
    case Limit::Of::Nothing:
      break;
  }
  return "not judged";
}

std::string measuredText(const ReproducedRow& row) {
  return figureText(row.measured) + (row.sd ? formatted(" +- %.3g", *row.sd) : "");
}

std::string offText(const ReproducedRow& row) {
  if (!row.isPublished() || std::isnan(row.measured)) return "-";
  if (row.limit.of == Limit::Of::Relative) return formatted("%+.1f %%", 100.0 * row.relative());
  return formatted("%+.3g", row.measured - row.published);
}

/// Columns as wide as what stands in them.
struct Widths {
  int row = 3;
  int quantity = 8;
  int measured = 10;
};

Widths widthsOf(const ReproducedTable& table) {
  Widths widths;
  for (const ReproducedRow& row : table.rows) {
    widths.row = std::max(widths.row, static_cast<int>(row.row.size()));
    widths.quantity = std::max(widths.quantity, static_cast<int>(row.quantity.size()));
    widths.measured = std::max(widths.measured, static_cast<int>(measuredText(row).size()));
  }
  return widths;
}

std::string tableText(const ReproducedTable& table) {
  const Widths widths = widthsOf(table);
  std::string text = "\n" + table.name + "\n";
  text += formatted("%-*s  %-*s %10s %*s %9s  %-15s\n", widths.row, "row", widths.quantity,
                    "quantity", "published", widths.measured, "measured", "off by", "within");
  std::vector<std::string> notes;
  std::string before;
  for (const ReproducedRow& row : table.rows) {
    const bool same = row.row == before;
    before = row.row;
    std::string verdict = row.limit.of == Limit::Of::Nothing ? "" : row.ok() ? "ok" : "NOT OK";
    if (!row.note.empty()) {
      auto found = std::ranges::find(notes, row.note);
      if (found == notes.end()) found = notes.insert(found, row.note);
      verdict += formatted(" [%d]", static_cast<int>(found - notes.begin()) + 1);
    }
    text += formatted("%-*s  %-*s %10s %*s %9s  %-15s %s\n", widths.row,
                      same ? "" : row.row.c_str(), widths.quantity, row.quantity.c_str(),
                      figureText(row.published).c_str(), widths.measured, measuredText(row).c_str(),
                      offText(row).c_str(), limitText(row.limit).c_str(), verdict.c_str());
  }
  for (std::size_t i = 0; i < notes.size(); ++i) {
    text += "  [" + std::to_string(i + 1) + "] " + notes[i] + "\n";
  }
  return text;
}

}  // namespace

Json toJson(const Reproduction& reproduction) {
  Json json = reportEnvelope("pneuma/reproduce/1", {}, Json::object(), 1);
  json["paper"] = reproduction.paper;
  json["citation"] = reproduction.citation;
  json["tables"] = Json::array();
  for (const ReproducedTable& table : reproduction.tables) {
    Json rows = Json::array();
    for (const ReproducedRow& row : table.rows) rows.push_back(rowJson(row));
    json["tables"].push_back({{"id", table.id}, {"name", table.name}, {"rows", std::move(rows)}});
  }
  json["ok"] = reproduction.ok();
  return json;
}

std::string textOf(const Reproduction& reproduction) {
  std::string text = reproduction.citation + "\n";
  for (const ReproducedTable& table : reproduction.tables) text += tableText(table);
  return text;
}

}  // namespace pneuma
