#include "growth/kitaoka_rules.h"

#include <algorithm>
#include <cmath>

namespace pneuma {

BranchingAngles rule6BranchingAngles(double shareA, double exponent) {
  const double share = std::clamp(shareA, 0.0, 1.0);
  // d_a^2 / d_0^2 and d_b^2 / d_0^2
  const double a = steady(std::pow(share, 2.0 / exponent));
  const double b = steady(std::pow(1.0 - share, 2.0 / exponent));
  const Turn right{0.0, 1.0};
  const Turn straight{1.0, 0.0};
  if (a <= 0.0) return {right, straight};
  if (b <= 0.0) return {straight, right};
  return {Turn::ofCosine((1.0 + a * a - b * b) / (2.0 * a)),
          Turn::ofCosine((1.0 + b * b - a * a) / (2.0 * b))};
}

double rule6Diameter(double flow, double trunkDiameterMm, double exponent) {
  return trunkDiameterMm * steady(std::pow(flow, 1.0 / exponent));
}

bool rule4aApplies(const BranchingAngles& angles) {
  static const double cosine = Turn::ofDegrees(10.0).cosine;
  return angles.a.minus(angles.b).cosine <= cosine;
}

Turn rule4aBend(const BranchingAngles& angles) { return angles.a.minus(angles.b).half(); }

Turn rule6aCorrected(const Turn& angle, const Turn& bisecting) {
  if (bisecting.minus(angle).sine <= 0.0) return angle;  // not larger
  const Turn mean = angle.bisector(bisecting);
  return mean.cosine < 0.0 ? Turn{0.0, 1.0} : mean;
}

double rule7aLengthToDiameter(double start, double distanceMm, double diameterMm,
                              const KitaokaOptions& options) {
  constexpr double Step = 0.25;
  constexpr double Least = 1.0;
  const double distance = distanceMm / diameterMm;
  double ratio = start;
  if (distance / ratio < options.minDistanceToLength) {
    while (distance / ratio < options.minDistanceToLength && ratio > Least) ratio -= Step;
    return std::max(ratio, std::min(start, Least));
  }
  while (distance / ratio > options.maxDistanceToLength) ratio += Step;
  return ratio;
}

Vec3 rule8InPlane(const Vec3& u, const Vec3& planeNormal, const Turn& rotation) {
  const Vec3 e1 = planeNormal.cross(u);
  return rotation.cosine * e1 + rotation.sine * planeNormal;
}

}  // namespace pneuma
