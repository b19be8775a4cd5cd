#include "pipeline/variation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "core/scaled_domain.h"
#include "core/units.h"

namespace pneuma {
namespace {

constexpr int MostDraws = 100;

/// Normal with mean 0 and standard deviation `sd`, cut off at 3 `sd`.
double draw(Random& random, double sd) {
  double value = random.normal();
  while (std::abs(value) > 3.0) value = random.normal();
  return sd * value;
}

/// The tree with `place` applied to every point and all radii and volumes scaled by `factor`.
template <class Place>
AirwayTree placed(const AirwayTree& tree, double factor, Place&& place) {
  AirwayTree result;
  result.reserve(tree.size());
  for (Branch branch : tree) {
    branch.proximal = place(branch.proximal);
    branch.distal = place(branch.distal);
    branch.radiusMm *= factor;
    branch.suppliedMl *= factor * factor * factor;
    for (CentrelinePoint& point : branch.via) {
      point.position = place(point.position);
      point.radiusMm *= factor;
    }
    result.add(std::move(branch));
  }
  return result;
}

LungModel scaled(const LungModel& model, double factor) {
  Box3 box;
  for (const LobeRegion& region : *model.regions) box.extend(region.domain->bounds());
  const Vec3 centre = box.center();
  auto regions = std::make_shared<std::vector<LobeRegion>>(*model.regions);
  for (LobeRegion& region : *regions) {
    region.domain = std::make_shared<ScaledDomain>(region.domain, centre, factor);
  }
  LungModel next = model;
  next.regions = std::move(regions);
  next.central =
      std::make_shared<const AirwayTree>(placed(*model.central, factor, [&](const Vec3& p) -> Vec3 {
        return centre + factor * (p - centre);
      }));
  return next;
}

/// The trunk turned by `turn` radians about its start, towards `azimuth` around it, and `longer`
/// times as long; what hangs on it goes with its end.
AirwayTree withTrunk(const AirwayTree& tree, double turn, double azimuth, double longer) {
  const Branch& trunk = tree[0];
  const Vec3 start = trunk.proximal;
  const Vec3 along = direction(trunk);
  const Vec3 axis = rotated(anyPerpendicular(along), along, azimuth);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn, axis).toRotationMatrix();
  const Vec3 shift = (longer - 1.0) * (rotation * (trunk.distal - start));
  AirwayTree turned = placed(
      tree, 1.0, [&](const Vec3& p) -> Vec3 { return start + rotation * (p - start) + shift; });
  AirwayTree result;
  result.reserve(turned.size());
  for (Branch branch : turned) {
    if (branch.parent < 0) branch.proximal = start;
    result.add(std::move(branch));
  }
  return result;
}

/// The region that holds `p`; nothing if none does.
const LobeRegion* regionAt(const std::vector<LobeRegion>& regions, const Vec3& p) {
  const auto found = std::ranges::find_if(
      regions, [&](const LobeRegion& region) { return region.domain->contains(p); });
  return found == regions.end() ? nullptr : &*found;
}

bool keepsEndsInside(const AirwayTree& before, const AirwayTree& after,
                     const std::vector<LobeRegion>& regions) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    const LobeRegion* region = regionAt(regions, before[i].distal);
    if (region != nullptr && !region->domain->contains(after[i].distal)) return false;
  }
  return true;
}

void requireTemplate(const AirwayTree& central) {
  for (const Branch& branch : central) {
    if (branch.origin == Origin::Template) continue;
    throw InvalidInput(
        "the trunk can vary only in template airways, but the central airways were measured; leave "
        "out --central, or vary the organ's scale alone");
  }
}

}  // namespace

LungModel varied(const LungModel& model, const VariationOptions& options, std::uint64_t seed) {
  requireValid(options);
  if (!options.any()) return model;
  LungModel next = readyToGrow(model);
  // A stream of its own, so that growth with the same seed does not repeat these numbers.
  Random random(seed ^ 0x9E3779B97F4A7C15U);
  if (options.organScale > 0.0) next = scaled(next, 1.0 + draw(random, options.organScale));
  if (options.trunkTurnDeg == 0.0 && options.trunkLength == 0.0) return next;
  requireTemplate(*next.central);
  for (int i = 0; i < MostDraws; ++i) {
    const double turn = radians(draw(random, options.trunkTurnDeg));
    const double azimuth = random.uniform(0.0, std::numbers::pi);
    const double longer = 1.0 + draw(random, options.trunkLength);
    AirwayTree central = withTrunk(*next.central, turn, azimuth, longer);
    if (!keepsEndsInside(*next.central, central, *next.regions)) continue;
    next.central = std::make_shared<const AirwayTree>(std::move(central));
    return next;
  }
  throw InvalidInput("of " + std::to_string(MostDraws) +
                     " random turns and lengths of the trunk none keeps the central airways' ends "
                     "in their lobes; make trunk-turn or trunk-length smaller");
}

}  // namespace pneuma
