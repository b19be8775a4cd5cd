#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// A value for every point.
struct PointArray {
  std::string name;
  std::vector<int> values;
};

/// A VTP file with one vertex for every point. LPS, mm: the field data say so.
/// @param metadata more field data
/// @pre arrays have as many values as there are points
std::string pointsText(std::span<const Vec3> points, const std::vector<PointArray>& arrays,
                       const std::map<std::string, std::string>& metadata = {});

}  // namespace pneuma
