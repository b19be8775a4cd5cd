#pragma once

#include <span>
#include <string_view>

#include "pipeline/reproduce.h"

namespace pneuma {

/// A table that can be asked for.
struct PaperTable {
  std::string_view id;
  std::string_view name;
};

/// A paper with its experiments; each has a source file of its own.
struct Paper {
  std::string_view name;
  std::string_view citation;
  std::span<const PaperTable> tables;

  /// Fills tables and figures. The table that is asked for is one of `tables`, or all.
  void (*reproduce)(const ReproduceOptions& options, Reproduction& result,
                    const Progress& progress);
  bool needsData = false;  ///< real data, which are not part of the project
};

const Paper& huang2004();
const Paper& kitaoka1999();
const Paper& lungMotion();
const Paper& santhanam2003();
const Paper& santhanam2008();
const Paper& zhang2003();

/// True if the options ask for this table.
inline bool wanted(const ReproduceOptions& options, std::string_view table) {
  return options.table.empty() || options.table == table;
}

}  // namespace pneuma
