#pragma once

#include "pipeline/detail/ct_body.h"
#include "pipeline/sample_lung.h"

namespace pneuma {

/// What makes the lungs of the sample CT hard to find.
struct ThoraxVariant {
  bool collapsed = false;        ///< the lower part of the left lung holds no air
  bool stomachGas = false;       ///< a bubble directly below the left dome
  double touchingLungsMm = 0.0;  ///< how deep from front to back the lungs touch; 0: nowhere
};

/// Both lungs with what they consist of, the collapsed part first.
CtBody lungShapes(const ThoraxVariant& variant);

/// Everything of the trunk but lungs, airways and their vessels, and the table below it.
CtBody trunkShapes(const ThoraxVariant& variant);

/// Level of the cage that both lungs lie in: positive inside. The ribs run around it.
double cageLevel(const Vec3& p);

}  // namespace pneuma
