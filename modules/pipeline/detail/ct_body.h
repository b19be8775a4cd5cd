#pragma once

#include <functional>
#include <vector>

#include "anatomy/lobe.h"
#include "core/math.h"

namespace pneuma {

/// A part of the body of the sample CT. LPS, mm.
struct CtShape {
  Box3 box;  ///< holds it
  /// Positive inside, negative outside, at most the distance to its wall.
  std::function<double(const Vec3&)> level;
  double hu = 0.0;
  std::function<double(const Vec3&)> huAt = {};  ///< where set, instead of `hu`
  Lobe label = Lobe::Whole;
  bool labelledAsLung = false;  ///< its voxels count to the lung that they lie in: vessels
};

/// Where shapes overlap, the first of them counts; where there is none is air.
using CtBody = std::vector<CtShape>;

inline constexpr double AirHu = -1000.0;

/// A box without limits.
Box3 endlessBox();

/// All of space around `box` that is at most `marginMm` away along an axis.
Box3 widened(const Box3& box, double marginMm);

/// A straight tube with round ends, from one radius to another.
struct CtTube {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  double fromRadiusMm = 0.0;
  double toRadiusMm = 0.0;

  double level(const Vec3& p) const;
  Box3 box() const;
};

CtShape tubeShape(const CtTube& tube, double hu);

}  // namespace pneuma
