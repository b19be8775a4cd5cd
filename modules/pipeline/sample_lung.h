#pragma once

#include <optional>
#include <vector>

#include "anatomy/lobe.h"
#include "core/math.h"
#include "pipeline/sample_fissure.h"

namespace pneuma {

/// The smaller of two levels with the edge between them rounded over about `width`; never larger
/// than the minimum, and 1-Lipschitz if both are.
double roundedMin(double a, double b, double width);

/// Level of the outside of an ellipsoid about `centre`: 0 on it, 1-Lipschitz. An infinite semi-axis
/// makes it a cylinder.
double outsideEllipsoid(const Vec3& p, const Vec3& centre, const Vec3& semiAxes);

/// The shape of one lung of the sample chest and its fissures. Frame of the pleura's model: x away
/// from the midline, y to the front, z up, carina at the origin, mm.
struct SampleLung {
  Side side = Side::Right;
  double scale = 1.0;  ///< of the whole pleura
  Vec3 heartCentre;    ///< at scale 1
  Vec3 heartSemiAxes;
  SampleFissure oblique;                    ///< LPS
  std::optional<SampleFissure> horizontal;  ///< LPS; right lung only

  /// The diaphragm's dome, at scale 1: what of this ellipsoid reaches into the lung.
  static const Vec3 DomeCentre;
  static const Vec3 DomeSemiAxes;

  Vec3 modelFromLps(const Vec3& p) const {
    return {side == Side::Left ? p.x() : -p.x(), -p.y(), p.z()};
  }

  Vec3 lpsFromModel(const Vec3& p) const { return modelFromLps(p); }  // its own inverse

  /// Positive inside the pleura, negative outside, 0 on it; at most the distance to it. The lung of
  /// docs/algorithms/centroid-splitting.md with rounded edges and a smaller diaphragm.
  double pleura(const Vec3& model) const;

  /// The oblique one first.
  std::vector<SampleFissure> fissures() const;

  /// LPS box of the lung.
  Box3 bounds() const;
};

/// Both have the volumes of an adult man's lungs at rest: about 3.3 and 2.9 l. The left one gives
/// way to the heart.
SampleLung sampleLung(Side side);

}  // namespace pneuma
