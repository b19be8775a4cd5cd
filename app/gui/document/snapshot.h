#pragma once

#include <QString>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "document/fissure_traces.h"
#include "document/tree_figures.h"
#include "pipeline/lobe_edits.h"
#include "pipeline/lung_corrections.h"
#include "pipeline/lung_model.h"
#include "pipeline/lung_shape.h"
#include "pipeline/stiffness_region.h"

namespace pneuma {

struct Breath;

/// Everything the window shows at one moment. A copy costs a few pointers, so undo keeps whole
/// ones.
struct Snapshot {
  LungModel model;
  std::shared_ptr<const TreeFigures> figures;      ///< of treeOf(model); null if there is no tree
  QString name;                                    ///< file names only, never folders
  LungOptions lungOptions{};                       ///< with which model.lungs were found
  std::shared_ptr<const LungCorrections> drawn{};  ///< the corrections that surfaces and figures of
                                                   ///< the lungs follow; null: none
  std::vector<std::shared_ptr<const LungShape>> lungs{};  ///< whole ones, fit to be split
  std::shared_ptr<const LabelImage> lungLabels{};         ///< of `lungs`, where a CT has no labels
  LobeEdits lobeEdits{};                                  ///< for the next split
  LobeEdits splitEdits{};                                 ///< with which model.lobes were made
  std::shared_ptr<const FissureTraces> traces{};  ///< of edits that may be older; null: none yet
  std::map<Fissure, FissureReview> reviews{};
  std::shared_ptr<const std::vector<LobeSurface>> grownIn{};  ///< the surfaces of model.growth
  std::vector<StiffnessRegion> regions{};                     ///< for the next breath
  std::shared_ptr<const Breath> breath{};  ///< of the surfaces and the tree; null: none yet
  std::uint64_t revision = 0;              ///< another one for every other state of the work

  /// True if surfaces and figures of the lungs are those of the labels.
  bool lungsFollow() const { return drawn == model.corrections; }
};

/// A snapshot of `model` with the figures of its tree and its whole lungs.
Snapshot snapshotOf(LungModel model, const QString& name);

/// The next snapshot of the same case: what was chosen, and what `model` shares with the one
/// before, stay.
Snapshot nextSnapshot(const Snapshot& before, LungModel model);

/// Sum of the closed surfaces' volumes, ml.
double lungVolumeMl(const LungModel& model);

/// "a CT of 512 × 512 × 133 voxels and 5 surfaces"
QString whatWasRead(const LungModel& model);

/// What a person should look at: warnings of reading and growing, and failed checks of the tree.
std::vector<QString> warningsOf(const Snapshot& snapshot);

}  // namespace pneuma
