#pragma once

#include "core/image.h"

namespace pneuma {

/// Whether left and right are where the header says, by what most people have: a heart that
/// reaches farther to the left, a larger right lung, a higher right dome of the diaphragm. Each is
/// a vote of +1 where it is as usual, -1 where it is the other way round, 0 where it is neither.
struct Handedness {
  int heart = 0;
  int volume = 0;
  int dome = 0;

  /// -3 to 3; at -2 left and right may be swapped.
  int votes() const { return heart + volume + dome; }
};

/// @param labels upright, 10 right lung, 20 left lung
/// @param middle of the body along i, voxels
Handedness handednessOf(const LabelImage& labels, double middle);

}  // namespace pneuma
