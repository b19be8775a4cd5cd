#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "pipeline/tree_measurement.h"

namespace pneuma {

/// A tree that was read to be compared with others.
struct OpenedTree {
  std::string label;  ///< short, and no other's: the heading of its column
  InputFile input;
  std::string format;                           ///< "VTP", "VTU", "SWC", "CSV", "JSON"
  std::map<std::string, std::string> metadata;  ///< what its file says: method, options, seed, ...
  std::vector<std::string> notes;               ///< whole sentences: what was converted or left out
  std::shared_ptr<const AirwayTree> tree;

  /// The growth method; "" if the file does not say.
  std::string method() const;
};

/// A tree with what was measured of it.
struct ComparedTree {
  OpenedTree opened;
  TreeMeasurement measured;
};

/// Trees beside each other, in the order they were given.
struct TreeComparison {
  std::vector<ComparedTree> trees;
  std::uint64_t seed = 1;  ///< of the random points of the gap
};

/// A short name for every path and a different one for each: its stem; among equal stems with the
/// extension, or as many folders before it as are needed; "name (2)" where a path comes twice.
std::vector<std::string> shortNames(std::span<const std::filesystem::path> paths);

/// Reads trees that are to be compared.
/// @throws Unsupported for a surface; as readTree()
std::vector<OpenedTree> openTrees(std::span<const std::filesystem::path> paths,
                                  const Progress& progress = {});

/// Measures trees in the regions of `organ`, if it has any; each as measureTree() does. Trees are
/// measured side by side as far as cores and memory allow; the result does not depend on it.
/// @throws InvalidOption for fewer than two trees; InvalidInput for an empty one; Cancelled
TreeComparison compareTrees(std::vector<OpenedTree> trees, const LungModel& organ = {},
                            std::uint64_t seed = 1, const Progress& progress = {});

/// "pneuma/compare/1" (resources/schemas/compare.schema.json).
/// @param parameters of the report's envelope
Json toJson(const TreeComparison& comparison, const LungModel& organ,
            Json parameters = Json::object());

/// Where a figure lies by what was published.
enum class BandSide { NoBand, Below, Within, Above };

/// One figure of every tree.
struct ComparisonRow {
  std::string key;                  ///< its place in the JSON report, levels joined by slashes
  std::string label;                ///< for people, with the unit
  std::vector<std::string> values;  ///< one for each tree; "-" where it is not known
  std::vector<BandSide> sides;      ///< likewise; a single published value is no band
  std::string published;            ///< "2.5 to 2.8"; empty if there is none
  std::string source;
};

/// The figures of the table for people, in its order; those that no tree has are left out.
std::vector<ComparisonRow> comparisonRows(const TreeComparison& comparison);

/// One table for people: quantity, one column for each tree, the published band and its source.
std::string compareText(const TreeComparison& comparison);

/// "region,quantity,LABEL,LABEL,...,published_low,published_high,source": the CSV of measure with a
/// column for each tree. One line per figure that is known of one of them; others' fields are
/// empty.
std::string compareCsv(const TreeComparison& comparison);

}  // namespace pneuma
