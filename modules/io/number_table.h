#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pneuma {

/// Columns of numbers out of a CSV file.
struct NumberTable {
  std::string name;                         ///< of the file, in quotation marks
  std::vector<std::size_t> lines;           ///< of each row in the file, from 1
  std::vector<std::string_view> columns;    ///< by which name each wanted column was found
  std::vector<std::vector<double>> values;  ///< of each wanted column, by row
};

/// Reads some columns of a table with a head; others may hold anything. Columns are parted by
/// commas, semicolons or tabs; empty lines and those that begin with # are passed over.
/// @param wanted for each column the names it may have, lower case; one of them must be there
/// @throws InputMissing; InvalidInput naming the line and column that is no number, a column that
/// is missing or there twice, a line of another length
NumberTable readNumberTable(const std::filesystem::path& path,
                            std::span<const std::vector<std::string_view>> wanted);

}  // namespace pneuma
