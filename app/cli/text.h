#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma::cli {

/// "1,234,567"
std::string grouped(double wholeNumber);

/// `value` with `digits` behind the point.
std::string fixed(double value, int digits);

/// Columns: the first flush left, the others flush right.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// `text` as one single-quoted word of a POSIX shell.
std::string shellQuoted(std::string_view text);

/// JSON as it goes to a file or to standard output: indented, one newline at the end, and valid
/// even where a path is not.
std::string jsonText(const Json& json);

/// One line per warning on standard error.
void printWarnings(const std::vector<std::string>& warnings);

/// One line per check of a report that failed, with value and limit; "" if all passed.
std::string failedChecks(const Json& report);

}  // namespace pneuma::cli
