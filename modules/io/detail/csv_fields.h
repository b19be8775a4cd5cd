#pragma once

#include <string_view>
#include <vector>

namespace pneuma {

/// The text without a byte order mark before it.
std::string_view withoutByteOrderMark(std::string_view text);

/// What parts the columns of a table, by its first line: a comma, else a semicolon, else a tab.
char csvDelimiter(std::string_view line);

/// The fields of a line, without blanks and quotation marks around them.
void splitCsv(std::string_view line, char delimiter, std::vector<std::string_view>& fields);

}  // namespace pneuma
