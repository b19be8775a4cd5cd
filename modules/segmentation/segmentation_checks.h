#pragma once

#include <vector>

#include "segmentation/lung_segmentation.h"

namespace pneuma {

/// Everything that tells whether lungs and airways were found well, with the limits it should keep.
std::vector<SegmentationCheck> segmentationChecks(const LungSegmentation& found);

}  // namespace pneuma
