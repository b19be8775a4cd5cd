#include "support/lobe_dice.h"

#include <algorithm>
#include <cmath>

#include "lobes/fissure_fit.h"

namespace pneuma::testing {

LungVoxels lungVoxels(Side side, const Box3& box, double voxelMm,
                      const std::function<bool(const Vec3&)>& lungAt) {
  LungVoxels lung;
  lung.side = side;
  const Vec3 first = box.min().array() + voxelMm / 2.0;
  for (double z = first.z(); z < box.max().z(); z += voxelMm) {
    for (double y = first.y(); y < box.max().y(); y += voxelMm) {
      for (double x = first.x(); x < box.max().x(); x += voxelMm) {
        if (lungAt({x, y, z})) lung.centres.emplace_back(x, y, z);
      }
    }
  }
  return lung;
}

LungBox boxOf(const LungVoxels& lung) {
  LungBox box;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vec3& p : lung.centres) values.push_back(p[axis]);
    box.low[axis] = quantile(values, 0.005);
    box.high[axis] = quantile(values, 0.995);
  }
  return box;
}

std::vector<Lobe> lobesBy(const FissureSurfaces& fissures, const LungVoxels& lung) {
  const bool right = lung.side == Side::Right;
  const HeightSurface& oblique = fissures.at(right ? Fissure::RightOblique : Fissure::LeftOblique);
  const HeightSurface* horizontal = right ? &fissures.at(Fissure::RightHorizontal) : nullptr;
  std::vector<Lobe> lobes;
  lobes.reserve(lung.centres.size());
  for (const Vec3& p : lung.centres) {
    const bool belowHorizontal = horizontal != nullptr && horizontal->height(p) < 0.0;
    lobes.push_back(lobeBy(lung.side, oblique.height(p) < 0.0, belowHorizontal));
  }
  return lobes;
}

std::map<Lobe, double> dice(const std::vector<Lobe>& one, const std::vector<Lobe>& other) {
  std::map<Lobe, double> both;
  std::map<Lobe, double> each;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i] == other[i]) both[one[i]] += 1.0;
    each[one[i]] += 1.0;
    each[other[i]] += 1.0;
  }
  std::map<Lobe, double> result;
  for (const auto& [lobe, sum] : each) result[lobe] = 2.0 * both[lobe] / sum;
  return result;
}

HeightSurface planeThrough(const std::vector<Vec3>& points) {
  const BestPlane plane = bestPlane(points);
  HeightSurface surface;
  surface.centre = plane.centre;
  surface.axes = plane.axes;
  surface.scale = plane.scale;
  return surface;
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

}  // namespace pneuma::testing
