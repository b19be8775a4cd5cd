#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "io/detail/branch_rows.h"
#include "io/detail/csv_fields.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_comments.h"
#include "io/detail/tree_formats.h"

namespace pneuma {
namespace {

enum Column {
  Id,
  Parent,
  Lobe_,
  Segment,
  X0,
  Y0,
  Z0,
  X1,
  Y1,
  Z1,
  Diameter,
  Origin_,
  Ending_,
  Supplied
};

constexpr std::array<std::string_view, 14> ReadColumns = {
    "id", "parent", "lobe", "segment",     "x0",     "y0",     "z0",
    "x1", "y1",     "z1",   "diameter_mm", "origin", "ending", "supplied_ml"};

/// Columns that follow from the others.
constexpr std::array<std::string_view, 8> DerivedColumns = {
    "side",      "generation",    "horsfield_order", "strahler_order",
    "length_mm", "flow_fraction", "region_ml",       "terminal"};

constexpr std::array<Column, 9> RequiredColumns = {Id, Parent, X0, Y0, Z0, X1, Y1, Z1, Diameter};

/// The table's head: where in a line the columns that are read stand.
struct Head {
  std::vector<std::string> names;
  std::array<std::size_t, ReadColumns.size()> place;
  char delimiter = ',';

  static constexpr std::size_t Missing = static_cast<std::size_t>(-1);

  bool has(Column column) const { return place[column] != Missing; }
};

Head headOf(std::string_view line, const std::string& name, std::vector<std::string>& notes) {
  Head head;
  head.place.fill(Head::Missing);
  head.delimiter = csvDelimiter(line);
  std::vector<std::string_view> fields;
  splitCsv(line, head.delimiter, fields);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string column = lowerCase(fields[i]);
    head.names.push_back(column);
    const auto known = std::find(ReadColumns.begin(), ReadColumns.end(), column);
    if (known != ReadColumns.end()) {
      std::size_t& place = head.place[static_cast<std::size_t>(known - ReadColumns.begin())];
      if (place != Head::Missing) {
        throw InvalidInput(name + " has two columns \"" + column + "\"; delete or rename one");
      }
      place = i;
    } else if (std::find(DerivedColumns.begin(), DerivedColumns.end(), column) ==
               DerivedColumns.end()) {
      notes.push_back(name + " has a column \"" + column +
                      "\" that is not known; it was left out.");
    }
  }
  for (const Column column : RequiredColumns) {
    if (head.has(column)) continue;
    throw InvalidInput(name + " has no column \"" + std::string(ReadColumns[column]) +
                       "\" in its first line; a tree needs id, parent, x0, y0, z0, x1, y1, z1 and "
                       "diameter_mm");
  }
  return head;
}

/// The fields of one line as numbers.
class Row {
 public:
  Row(const Head& head, const std::vector<std::string_view>& fields, const std::string& name,
      std::size_t line)
      : head_(head), fields_(fields), name_(name), line_(line) {}

  double number(Column column) const {
    const std::string_view text = fields_[head_.place[column]];
    const std::optional<double> number = parseDouble(text);
    if (!number.has_value() || !std::isfinite(*number)) {
      throw InvalidInput(where(column) + ": \"" + std::string(text) + "\" is not a number");
    }
    return *number;
  }

  std::int64_t integer(Column column) const {
    const std::string_view text = fields_[head_.place[column]];
    const std::optional<std::int64_t> number = parseInteger(text);
    if (number.has_value()) return *number;
    throw InvalidInput(where(column) + ": \"" + std::string(text) + "\" is not a whole number");
  }

  std::string where(Column column) const {
    return name_ + ", line " + std::to_string(line_) + ", column " +
           std::string(ReadColumns[column]);
  }

 private:
  const Head& head_;
  const std::vector<std::string_view>& fields_;
  const std::string& name_;
  std::size_t line_;
};

BranchRow branchRow(const Head& head, const Row& row) {
  BranchRow result;
  result.id = row.integer(Id);
  result.parent = row.integer(Parent);
  Branch& branch = result.branch;
  branch.proximal = Vec3(row.number(X0), row.number(Y0), row.number(Z0));
  branch.distal = Vec3(row.number(X1), row.number(Y1), row.number(Z1));
  const double diameterMm = row.number(Diameter);
  if (!(diameterMm > 0.0)) {
    throw InvalidInput(row.where(Diameter) + ": the diameter is " + numberText(diameterMm) +
                       " mm; it must be above 0");
  }
  branch.radiusMm = diameterMm / 2.0;
  branch.origin = Origin::Measured;
  if (head.has(Lobe_)) branch.lobe = lobeOfValue(row.number(Lobe_), row.where(Lobe_));
  if (head.has(Segment)) branch.segment = segmentOfValue(row.number(Segment), row.where(Segment));
  if (head.has(Origin_)) branch.origin = originOfValue(row.number(Origin_), row.where(Origin_));
  if (head.has(Ending_)) branch.ending = endingOfValue(row.number(Ending_), row.where(Ending_));
  if (head.has(Supplied)) branch.suppliedMl = row.number(Supplied);
  return result;
}

}  // namespace

TreeFile readTreeCsv(const std::string& content, const std::string& name) {
  const std::string_view text = withoutByteOrderMark(content);
  TreeFile file;
  file.format = "CSV";
  TreeComments comments;
  std::optional<Head> head;
  std::vector<BranchRow> rows;
  std::vector<std::string_view> fields;
  Lines lines(text);
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    if (line->starts_with('#')) {
      comments.add(*line);
      continue;
    }
    if (!head.has_value()) {
      head = headOf(*line, name, file.notes);
      continue;
    }
    splitCsv(*line, head->delimiter, fields);
    if (fields.size() != head->names.size()) {
      throw InvalidInput(name + ", line " + std::to_string(lines.number()) + " has " +
                         std::to_string(fields.size()) + " columns, the first line has " +
                         std::to_string(head->names.size()) + "; is the file complete?");
    }
    rows.push_back(branchRow(*head, Row(*head, fields, name, lines.number())));
  }
  if (!head.has_value()) throw InvalidInput(name + " holds no table; is the file complete?");
  comments.requireCount(BranchCountKey, rows.size(), content, name);
  file.tree = treeOfRows(std::move(rows), name, file.notes);
  file.metadata = std::move(comments.metadata);
  if (comments.ras) {
    file.tree = turnedFromRas(file.tree);
    file.notes.push_back(turnedFromRasNote(name));
  }
  return file;
}

}  // namespace pneuma
