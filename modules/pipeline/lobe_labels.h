#pragma once

#include "core/image.h"
#include "core/progress.h"
#include "pipeline/split_lobes.h"

namespace pneuma {

/// The lungs of a label image in lobes, by the same surfaces as the meshes: what stands below a
/// fissure's height goes to the lower lobe, and so on. Where a fissure folds, the meshes tell the
/// lobes themselves. Airways stay. A piece that the cut of the meshes had joined to the lobe around
/// it goes there here as well.
/// @param lungs labels 10 and 20 are divided, all others stay; lungs that were not split stay
/// @throws Cancelled
LabelImage lobeLabels(const LabelImage& lungs, const LobesOfLungs& lobes,
                      const Progress& progress = {});

/// Labels of lungs for lobeLabels() where there is no image: the voxels inside their surfaces.
/// @throws InvalidInput if the lungs are far too large
LabelImage lungLabels(const LungModel& model, double spacingMm = 1.0,
                      const Progress& progress = {});

}  // namespace pneuma
