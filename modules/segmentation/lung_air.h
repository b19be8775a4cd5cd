#pragma once

#include "core/image.h"
#include "core/progress.h"
#include "segmentation/airway_segmentation.h"
#include "segmentation/inner_air.h"

namespace pneuma {

/// Which air belongs to which lung, before vessels are closed.
struct LungAir {
  bool separated = true;
  double bridgeMm = 0.0;
  double middle = 0.0;  ///< of the body along i: the trachea, or the middle of all soft tissue;
                        ///< voxels
  double elsewhereMl =
      0.0;  ///< of other spaces of air at the height of the lungs' upper two thirds
};

/// Marks the air of the right lung by 10 and that of the left one by 20 in `labels`: the two
/// largest parts of the inner air on both sides of the trachea, or the largest one cut in two.
/// @param labels nonzero where airways are; on return nothing but lungs
/// @throws InvalidInput if there is no air that could be a lung
LungAir findLungAir(const CtImage& ct, const InnerAir& air, const AirwayMask& airways,
                    LabelImage& labels, const Progress& progress = {});

}  // namespace pneuma
