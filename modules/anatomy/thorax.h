#pragma once

#include <cstdint>

#include "anatomy/organ_shapes.h"
#include "core/domain.h"

namespace pneuma {

/// Both lungs of Kitaoka 1999 as one region: inside the thorax, above the diaphragm, without
/// mediastinum, vertebrae, heart and descending aorta. LPS, mm; the apex of the thorax is the
/// origin. The paper names the kinds of surfaces; their formulas are ours
/// (docs/algorithms/kitaoka.md).
class Thorax : public Domain {
 public:
  /// Of the lungs at scale 1; the paper's are 6,388 ml.
  static constexpr double VolumeMl = 6388.5;

  /// @param scale of all lengths
  explicit Thorax(double scale = 1.0);

  bool contains(const Vec3& p) const override;

  /// A lower bound; outside 0.
  double distanceToWall(const Vec3& p) const override;

  std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const override;
  double exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const override;

  Box3 bounds() const override { return contour_.bounds(); }

  double volumeMm3() const override;

 private:
  double scale_;
  double inverse_;
  SimpleOrgan contour_;  ///< the thorax' inner surface
};

}  // namespace pneuma
