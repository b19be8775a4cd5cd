#pragma once

#include <memory>

#include "pipeline/detail/ct_body.h"
#include "pipeline/detail/thorax_levels.h"

namespace pneuma {

/// What makes the lungs of the sample CT hard to find.
struct ThoraxVariant {
  bool collapsed = false;        ///< the lower part of the left lung holds no air
  bool stomachGas = false;       ///< a bubble directly below the left dome
  double touchingLungsMm = 0.0;  ///< how deep from front to back the lungs touch; 0: nowhere
};

/// Both lungs, the collapsed part first.
CtBody lungShapes(const ThoraxVariant& variant, const std::shared_ptr<const ThoraxLevels>& levels);

/// Everything of the trunk but lungs, airways and their vessels, and the table below it.
CtBody trunkShapes(const ThoraxVariant& variant, const std::shared_ptr<const ThoraxLevels>& levels);

}  // namespace pneuma
