#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pneuma {

/// A table of texts out of a CSV file.
struct TextTable {
  std::string name;                            ///< of the file, in quotation marks
  std::vector<std::string> columns;            ///< as its first line names them
  std::vector<std::size_t> lines;              ///< of each row in the file, from 1
  std::vector<std::vector<std::string>> rows;  ///< as long as `columns`
};

/// Reads a whole table of UTF-8. Columns are parted by commas, semicolons or tabs, whichever the
/// first line has; a field in quotation marks may hold them, and "" for one such mark, but no end
/// of line (RFC 4180 but for that). Empty lines and those that begin with # are passed over.
/// @throws InputMissing; InvalidInput naming the line: no table, no UTF-8, a
/// character that cannot be seen, a column without a name
/// or there twice, a row of another length, a quotation mark that is not closed
TextTable readTextTable(const std::filesystem::path& path);

}  // namespace pneuma
