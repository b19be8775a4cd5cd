#include "anatomy/organ.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string_view>

#include "anatomy/thorax.h"
#include "core/error.h"
#include "core/units.h"

namespace pneuma {
namespace {

constexpr double LeastMl = 1.0;
constexpr double MostMl = 1e5;
constexpr double TrunkDiameterMm = 18.0;  // at the volume of the paper's organ

void requirePossible(double volumeMl) {
  if (volumeMl >= LeastMl && volumeMl <= MostMl) return;
  std::ostringstream text;
  text << "an organ of " << volumeMl << " ml is not possible; choose 1 to 100000 ml";
  throw InvalidInput(text.str());
}

/// Factor of all lengths that brings an organ of `unitMl` to `volumeMl`.
double scaleOf(double volumeMl, double unitMl) {
  requirePossible(volumeMl);
  return std::cbrt(volumeMl / unitMl);
}

Organ withTrunk(std::shared_ptr<const Domain> domain) {
  const double height = domain->bounds().sizes().z();
  const double scale = std::cbrt(millilitres(domain->volumeMm3()) / SimpleOrgan::VolumeMl);
  Branch trunk;
  trunk.distal = Vec3(0.0, 0.0, -height / 4.0);
  trunk.radiusMm = scale * TrunkDiameterMm / 2.0;
  trunk.origin = Origin::Template;
  Organ organ;
  organ.region = {Lobe::Whole, std::move(domain)};
  organ.central.add(trunk);
  return organ;
}

}  // namespace

Organ simpleOrgan(double volumeMl) {
  return withTrunk(std::make_shared<SimpleOrgan>(scaleOf(volumeMl, SimpleOrgan::VolumeMl)));
}

Organ sphereOrgan(double volumeMl) {
  requirePossible(volumeMl);
  return withTrunk(std::make_shared<SphereOrgan>(
      std::cbrt(cubicMillimetres(volumeMl) * 3.0 / (4.0 * std::numbers::pi))));
}

Organ cylinderOrgan(double volumeMl) {
  requirePossible(volumeMl);
  const double radius = std::cbrt(cubicMillimetres(volumeMl) / (3.0 * std::numbers::pi));
  return withTrunk(std::make_shared<CylinderOrgan>(radius, 3.0 * radius));
}

Organ cubeOrgan(double volumeMl) {
  requirePossible(volumeMl);
  return withTrunk(std::make_shared<CubeOrgan>(std::cbrt(cubicMillimetres(volumeMl))));
}

LobeRegion thoraxRegion(double volumeMl) {
  return {Lobe::Whole, std::make_shared<Thorax>(scaleOf(volumeMl, Thorax::VolumeMl))};
}

}  // namespace pneuma
