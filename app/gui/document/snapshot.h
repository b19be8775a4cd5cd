#pragma once

#include <QString>
#include <memory>

#include "document/tree_figures.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// Everything the window shows at one moment. A copy costs a few pointers, so undo keeps whole
/// ones.
struct Snapshot {
  LungModel model;
  std::shared_ptr<const TreeFigures> figures;  ///< of treeOf(model); null if there is no tree
  QString name;                                ///< file names only, never folders
  LungOptions lungOptions{};                   ///< with which model.lungs were found
};

/// A snapshot of `model` with the figures of its tree.
Snapshot snapshotOf(LungModel model, const QString& name);

/// Sum of the closed surfaces' volumes, ml.
double lungVolumeMl(const LungModel& model);

/// What a person should look at: warnings of reading and growing, and failed checks of the tree.
std::vector<QString> warningsOf(const Snapshot& snapshot);

}  // namespace pneuma
