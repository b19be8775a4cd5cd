#pragma once

#include <optional>
#include <string>

#include "core/image.h"
#include "core/progress.h"
#include "segmentation/handedness.h"

namespace pneuma {

/// Whether left and right of a CT are where its header says.
struct OrientationCheck {
  std::optional<Handedness> hands;  ///< none if no lungs were found
  std::string sentence;             ///< for people, without a stop

  bool maybeSwapped() const { return hands && hands->votes() <= -2; }
};

/// Finds the lungs in every second or third voxel of the CT, roughly and fast, and asks which of
/// them is which.
/// @throws Cancelled
OrientationCheck checkOrientation(const CtImage& ct, const Progress& progress = {});

}  // namespace pneuma
