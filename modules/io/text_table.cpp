#include "io/text_table.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/csv_fields.h"
#include "io/detail/text_fields.h"
#include "io/json.h"

namespace pneuma {
namespace {

constexpr std::size_t MostBytes = std::size_t{64} << 20;

/// One line to its fields. Nothing if a quotation mark is not closed.
std::optional<std::vector<std::string>> fieldsOf(std::string_view line, char delimiter) {
  std::vector<std::string> fields(1);
  bool quotedField = false;
  bool inQuotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    std::string& field = fields.back();
    if (inQuotes) {
      if (c != '"') {
        field += c;
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        field += c;
        ++i;
      } else {
        inQuotes = false;
      }
    } else if (c == delimiter) {
      if (!quotedField) field = trimmed(field);
      fields.emplace_back();
      quotedField = false;
    } else if (c == '"' && trimmed(field).empty()) {
      field.clear();
      inQuotes = true;
      quotedField = true;
    } else if (!quotedField || (c != ' ' && c != '\t')) {
      field += c;
    }
  }
  if (inQuotes) return {};
  if (!quotedField) fields.back() = trimmed(fields.back());
  return fields;
}

/// Characters that cannot be seen, but for tabs.
bool hasControls(std::string_view text) {
  return std::ranges::any_of(text, [](char c) {
    return (static_cast<unsigned char>(c) < 0x20U && c != '\t') || c == 0x7F;
  });
}

bool isUtf8(std::string_view text) {
  try {
    return !Json(std::string(text)).dump().empty();
  } catch (const Json::type_error&) {
    return false;
  }
}

void requireColumns(const TextTable& table) {
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& column = table.columns[i];
    if (column.empty()) {
      throw InvalidInput(table.name + ": column " + std::to_string(i + 1) +
                         " has no name in the first line");
    }
    if (!seen.insert(column).second) {
      throw InvalidInput(table.name + " has two columns \"" + column + "\"; delete or rename one");
    }
  }
}

}  // namespace

TextTable readTextTable(const std::filesystem::path& path) {
  const std::string content = readFile(path, MostBytes);
  TextTable table;
  table.name = quoted(path);
  char delimiter = ',';
  Lines lines(withoutByteOrderMark(content));
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty() || line->starts_with('#')) continue;
    const std::string where = table.name + ", line " + std::to_string(lines.number());
    if (!isUtf8(*line)) {
      throw InvalidInput(where + " is not UTF-8; save the table as UTF-8 (\"CSV UTF-8\")");
    }
    if (hasControls(*line)) {
      throw InvalidInput(where + " holds a character that cannot be seen; is it a text?");
    }
    if (table.columns.empty()) delimiter = csvDelimiter(*line);
    std::optional<std::vector<std::string>> fields = fieldsOf(*line, delimiter);
    if (!fields) {
      throw InvalidInput(where + " has a quotation mark that is not closed in this line");
    }
    if (table.columns.empty()) {
      table.columns = std::move(*fields);
      requireColumns(table);
      continue;
    }
    if (fields->size() != table.columns.size()) {
      throw InvalidInput(where + " has " + std::to_string(fields->size()) +
                         " columns, the first line has " + std::to_string(table.columns.size()) +
                         "; put what holds a comma in quotation marks");
    }
    table.lines.push_back(lines.number());
    table.rows.push_back(std::move(*fields));
  }
  if (table.columns.empty()) {
    throw InvalidInput(table.name + " holds no table; is the file complete?");
  }
  return table;
}

}  // namespace pneuma
