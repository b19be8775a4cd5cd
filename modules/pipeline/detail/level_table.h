#pragma once

#include <functional>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// The level of a shape on a lattice, trilinear in between: for formulas that are asked for often.
class LevelTable {
 public:
  /// @param level smooth; called from several threads at once
  LevelTable(const std::function<double(const Vec3&)>& level, const Box3& box, double cellMm);

  /// Outside the box as at its nearest point.
  double operator()(const Vec3& p) const;

 private:
  Vec3 origin_;
  double cellMm_;
  Eigen::Vector3i size_;
  std::vector<float> levels_;
};

}  // namespace pneuma
