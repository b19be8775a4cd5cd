#pragma once

#include <string_view>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// One of the waves on a fissure: amplitude sin(x_per_mm x + y_per_mm y + phase). LPS.
struct FissureWave {
  double amplitudeMm = 0.0;
  double xPerMm = 0.0;
  double yPerMm = 0.0;
  double phase = 0.0;
};

/// Where two lobes of the sample chest meet:
///   z = height + slope y + bend y^2 + sideBend (x - side)^2 + waves. LPS, mm.
struct SampleFissure {
  std::string_view name;  ///< "right-oblique", "right-horizontal", "left-oblique"
  double heightMm = 0.0;
  double slope = 0.0;
  double bend = 0.0;      ///< 1/mm
  double sideBend = 0.0;  ///< 1/mm
  double sideMm = 0.0;
  std::vector<FissureWave> waves = {};
  double steepest = 1.0;          ///< what steepness() never exceeds in the lung's box
  std::vector<Vec3> points = {};  ///< of its part in the lung, 8 mm apart along x and y

  double zAt(double x, double y) const;

  /// Length of the gradient of z - zAt(x, y): a point a little above lies this much nearer than
  /// straight down.
  double steepness(double x, double y) const;

  /// Positive above; in the lung's box at most the distance.
  double above(const Vec3& p) const { return (p.z() - zAt(p.x(), p.y())) / steepest; }

  /// An upper bound of steepness() in a box.
  double steepestIn(const Box3& box) const;

  /// The same in a mirror, left for right.
  SampleFissure mirrored() const;
};

}  // namespace pneuma
