#pragma once

#include <vector>

namespace pneuma {

/// What distances between two boundaries come to, measured from each of them to the other.
struct DistanceSummary {
  double meanMm = 0.0;         ///< of both ways together
  double hausdorff95Mm = 0.0;  ///< 95th percentile, the larger of both ways
  double maxMm = 0.0;
};

/// @param there, back distances of the points of one boundary to the other, mm, in any order
/// @pre neither is empty
DistanceSummary summaryOf(std::vector<double> there, std::vector<double> back);

}  // namespace pneuma
