#pragma once

#include <QString>
#include <vector>

#include "document/snapshot.h"

namespace pneuma {

/// A line of the properties card: a figure, or a check with its answer.
struct PropertyRow {
  enum class Kind { Figure, Good, Look };
  QString label;
  QString value;
  Kind kind = Kind::Figure;
};

/// What the properties card says about the thing that is selected.
struct PropertySheet {
  QString title;
  QString headline;  ///< the one number that matters
  QString note;      ///< beside it
  std::vector<PropertyRow> rows;
};

/// A branch, by its index in the tree that is shown.
PropertySheet branchSheet(const Snapshot& snapshot, std::size_t branch);

/// A lobe or lung, by its index in the model's surfaces.
PropertySheet surfaceSheet(const Snapshot& snapshot, std::size_t surface);

/// All lungs, or one side's.
PropertySheet lungsSheet(const Snapshot& snapshot, Side which);

PropertySheet treeSheet(const Snapshot& snapshot);

/// Lungs and airways that were found in the CT, and the checks of them; empty if there are none.
PropertySheet foundLungsSheet(const Snapshot& snapshot);

/// A row for every surface that is open, good where it is fit to grow in, and for the central tree.
PropertySheet filesSheet(const Snapshot& snapshot);

}  // namespace pneuma
