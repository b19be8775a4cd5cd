#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// A branch as a row of a table, with the numbers that the file knows it by.
struct BranchRow {
  std::int64_t id = 0;
  std::int64_t parent = -1;  ///< the id of another row; -1 for the root
  Branch branch;             ///< its own `parent` is not used
};

/// The tree that the rows describe, in the order of the file or, if that has a child before its
/// parent, from the root downwards (which adds a note).
/// @param name of the file, in quotation marks, for messages
/// @throws InvalidInput: no branch, an id twice, a missing parent, no or two roots, a cycle,
/// numbers that are none, a radius that is not positive
AirwayTree treeOfRows(std::vector<BranchRow> rows, const std::string& name,
                      std::vector<std::string>& notes);

/// Whatever is written can be read back: one root, positive radii, finite numbers.
/// @throws InvalidInput naming the branch
void requireWritableTree(const AirwayTree& tree);

/// The value as a lobe. @throws InvalidInput naming `where` for a value that is none
Lobe lobeOfValue(double value, const std::string& where);

/// The value as an origin. @throws InvalidInput naming `where` for a value that is none
Origin originOfValue(double value, const std::string& where);

/// The value as an ending. @throws InvalidInput naming `where` for a value that is none
Ending endingOfValue(double value, const std::string& where);

/// The value as a segment, 0 to 255. @throws InvalidInput naming `where` for a value that is none
std::uint8_t segmentOfValue(double value, const std::string& where);

}  // namespace pneuma
