#include "io/number_table.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/csv_fields.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

using Names = std::vector<std::string_view>;

std::string alternatives(const Names& names) {
  std::string text;
  for (const std::string_view name : names) {
    text.append(text.empty() ? "\"" : " or \"").append(name).append("\"");
  }
  return text;
}

/// Where the wanted columns stand; fills by which names.
std::vector<std::size_t> placesIn(std::span<const std::string_view> head,
                                  std::span<const Names> wanted, NumberTable& table) {
  std::vector<std::size_t> places;
  for (const Names& names : wanted) {
    bool found = false;
    for (std::size_t n = 0; n < head.size(); ++n) {
      const auto name = std::ranges::find(names, lowerCase(head[n]));
      if (name == names.end()) continue;
      if (found) {
        throw InvalidInput(table.name + " has two columns " + alternatives(names) +
                           "; delete or rename one");
      }
      found = true;
      places.push_back(n);
      table.columns.push_back(*name);
    }
    if (!found) {
      throw InvalidInput(table.name + " has no column " + alternatives(names) +
                         " in its first line; add or rename it");
    }
  }
  return places;
}

}  // namespace

NumberTable readNumberTable(const std::filesystem::path& path, std::span<const Names> wanted) {
  const std::string content = readFile(path);
  NumberTable table;
  table.name = quoted(path);
  table.values.resize(wanted.size());
  std::vector<std::size_t> places;
  std::vector<std::string_view> fields;
  std::size_t columns = 0;
  char delimiter = ',';
  Lines lines(withoutByteOrderMark(content));
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty() || line->starts_with('#')) continue;
    if (columns == 0) delimiter = csvDelimiter(*line);
    splitCsv(*line, delimiter, fields);
    if (columns == 0) {
      columns = fields.size();
      places = placesIn(fields, wanted, table);
      continue;
    }
    const std::string where = table.name + ", line " + std::to_string(lines.number());
    if (fields.size() != columns) {
      throw InvalidInput(where + " has " + std::to_string(fields.size()) +
                         " columns, the first line has " + std::to_string(columns) +
                         "; is the file complete?");
    }
    for (std::size_t n = 0; n < places.size(); ++n) {
      const std::string_view text = fields[places[n]];
      const std::optional<double> number = parseDouble(text);
      if (!number || !std::isfinite(*number)) {
        throw InvalidInput(where + ", column " + std::string(table.columns[n]) + ": \"" +
                           std::string(text) + "\" is not a number");
      }
      table.values[n].push_back(*number);
    }
    table.lines.push_back(lines.number());
  }
  if (columns == 0) throw InvalidInput(table.name + " holds no table; is the file complete?");
  return table;
}

}  // namespace pneuma
