#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pipeline/lung_model.h"
#include "segmentation/lung_edits.h"

namespace pneuma {

/// What a person corrected of the lungs of a model by hand, and what was there before. The model's
/// labels are those of before with the edits; its `lungs` are measured again.
struct LungCorrections {
  std::shared_ptr<const LungSegmentation> found;  ///< null where the labels were read
  std::shared_ptr<const LabelImage> read;         ///< those labels; null where lungs were found
  std::vector<LungEdit> edits;                    ///< in the order they were made; at least one

  const LabelImage& before() const { return found ? found->labels : *read; }
};

/// Why the lungs of a model cannot be corrected, as the rest of a sentence; empty if they can.
std::string correctionObstacle(const LungModel& model);

/// The model with more edits, whose labels somebody made already. Its surfaces and figures are
/// those from before: see measuredAgain() and withSurfaces(). Lobes and what was grown are gone.
/// @pre correctionObstacle() is empty
LungModel withEdits(const LungModel& model, std::vector<LungEdit> edits,
                    std::shared_ptr<const LabelImage> labels);

/// The labels of a corrected model, made again by its edits.
/// @pre model.ct and model.corrections @throws as editedLabels()
std::shared_ptr<const LabelImage> correctedLabels(const LungModel& model,
                                                  const Progress& progress = {});

/// The figures, checks and warnings of a model whose lungs were corrected follow its labels. Its
/// surfaces stay.
/// @param thresholdHu with which the lungs were found
LungModel measuredAgain(const LungModel& model, double thresholdHu, const Progress& progress = {});

/// Everything at once: the model with its lungs corrected by edits, measured again, without
/// surfaces and what was made of them.
/// @throws InvalidInput (no lungs, other voxels than the CT, an edit that cannot be), Cancelled
LungModel withLungEdits(const LungModel& model, std::span<const LungEdit> edits, double thresholdHu,
                        const Progress& progress = {});

}  // namespace pneuma
