#include "pipeline/aggregate_file.h"

#include <vector>

#include "io/point_file.h"

namespace pneuma {

std::string aggregateText(std::span<const AggregatePoint> aggregate,
                          const std::map<std::string, std::string>& metadata) {
  std::vector<Vec3> positions;
  PointArray arrival{"arrival", {}};
  PointArray lobe{"lobe", {}};
  for (const AggregatePoint& point : aggregate) {
    arrival.values.push_back(static_cast<int>(positions.size()));
    lobe.values.push_back(static_cast<int>(point.lobe));
    positions.push_back(point.position);
  }
  return pointsText(positions, {std::move(arrival), std::move(lobe)}, metadata);
}

}  // namespace pneuma
