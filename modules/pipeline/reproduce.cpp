#include "pipeline/reproduce.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "pipeline/reproduce_paper.h"

namespace pneuma {
namespace {

std::array<const Paper*, 6> papers() {
  return {&huang2004(),     &kitaoka1999(), &santhanam2003(),
          &santhanam2008(), &zhang2003(),   &lungMotion()};
}

const Paper& paperOfName(std::string_view name) {
  for (const Paper* paper : papers()) {
    if (paper->name == name) return *paper;
  }
  detail::throwUnknownChoice("the paper", name, reproduciblePapers());
}

}  // namespace

bool Limit::holds(double published, double measured) const {
  switch (of) {
    case Of::Relative:
      return std::abs(measured - published) <= most * std::abs(published);
    case Of::Difference:
      return std::abs(measured - published) <= most;
    case Of::Range:
      return low <= measured && measured <= high;
    case Of::Nothing:
      break;
  }
  return true;
}

bool Reproduction::ok() const {
  return std::ranges::all_of(tables, [](const ReproducedTable& table) {
    return std::ranges::all_of(table.rows, &ReproducedRow::ok);
  });
}

std::vector<std::string_view> reproduciblePapers() {
  std::vector<std::string_view> names;
  for (const Paper* paper : papers()) names.push_back(paper->name);
  return names;
}

std::vector<std::string_view> reproducibleTables(std::string_view paper) {
  std::vector<std::string_view> ids;
  for (const PaperTable& table : paperOfName(paper).tables) ids.push_back(table.id);
  return ids;
}

void requireReproducible(std::string_view paper, std::string_view table) {
  const std::vector<std::string_view> tables = reproducibleTables(paper);
  if (table.empty() || std::ranges::find(tables, table) != tables.end()) return;
  detail::throwUnknownChoice("the table of " + std::string(paper), table, tables);
}

bool needsData(std::string_view paper) { return paperOfName(paper).needsData; }

Reproduction reproduce(std::string_view paper, const ReproduceOptions& options,
                       const Progress& progress) {
  requireReproducible(paper, options.table);
  const Paper& found = paperOfName(paper);
  if (found.needsData && options.data.empty()) {
    throw InputMissing("'" + std::string(paper) +
                       "' is held to landmarks of people, which are not part of Pneuma; name the "
                       "folder of real data with --data or PNEUMA_TEST_DATA");
  }
  Reproduction result;
  result.paper = found.name;
  result.citation = found.citation;
  found.reproduce(options, result, progress);
  progress.report(1.0);
  return result;
}

}  // namespace pneuma
