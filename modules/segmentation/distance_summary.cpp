#include "segmentation/distance_summary.h"

#include <algorithm>

namespace pneuma {

DistanceSummary summaryOf(std::vector<double> there, std::vector<double> back) {
  DistanceSummary summary;
  double sum = 0.0;
  for (std::vector<double>* distances : {&there, &back}) {
    std::sort(distances->begin(), distances->end());
    for (const double d : *distances) sum += d;
    const auto rank = static_cast<std::size_t>(0.95 * static_cast<double>(distances->size() - 1));
    summary.hausdorff95Mm = std::max(summary.hausdorff95Mm, (*distances)[rank]);
    summary.maxMm = std::max(summary.maxMm, distances->back());
  }
  summary.meanMm = sum / static_cast<double>(there.size() + back.size());
  return summary;
}

}  // namespace pneuma
