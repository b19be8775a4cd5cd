#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/image.h"
#include "core/progress.h"

namespace pneuma {

/// How well one label of two images agrees.
struct LabelAgreement {
  std::uint8_t label = 0;
  double firstMl = 0.0;
  double secondMl = 0.0;
  double dice = 0.0;           ///< twice what both have over the sum of what each has
  double meanMm = 0.0;         ///< mean distance between the boundaries, both ways
  double hausdorff95Mm = 0.0;  ///< 95th percentile of these distances, the larger of both ways

  /// True if exactly one of the images has the label.
  bool inOneOnly() const { return (firstMl > 0.0) != (secondMl > 0.0); }

  /// Of the second over the first, as a share; infinite if one of them has none.
  double volumeDifference() const {
    if (inOneOnly()) return std::numeric_limits<double>::infinity();
    return firstMl > 0.0 ? secondMl / firstMl - 1.0 : 0.0;
  }
};

/// The labels that occur, ascending, without 0.
std::vector<std::uint8_t> labelsIn(const LabelImage& image);

/// Agreement of one label; distances are infinite where one of the images has none of it, 0 where
/// neither has.
/// @throws InvalidInput if the images do not have the same voxels at the same places
LabelAgreement agreement(const LabelImage& first, const LabelImage& second, std::uint8_t label);

/// The same of several labels taken as one, such as both lungs; `label` of the result is 0.
LabelAgreement agreement(const LabelImage& first, const LabelImage& second,
                         const std::vector<std::uint8_t>& labels);

}  // namespace pneuma
