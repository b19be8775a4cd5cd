#pragma once

#include "anatomy/lobe.h"
#include "core/math.h"

namespace pneuma {

/// A place of a lung at the end of expiration that was found again after it moved, mm. Mostly a
/// vessel's branching, which lies deep in the lung.
struct LandmarkPair {
  Vec3 rest = Vec3::Zero();
  Vec3 moved = Vec3::Zero();
  Side side = Side::None;  ///< the lung it lies in, once that is known
};

}  // namespace pneuma
