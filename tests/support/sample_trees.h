#pragma once

#include <functional>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/units.h"

/// Trees whose morphometry can be worked out by hand.
namespace pneuma::testing {

/// A straight branch from where `parent` ends, or from the origin, along `step`.
inline int addBranch(AirwayTree& tree, int parent, const Vec3& step, double radiusMm = 1.0,
                     Lobe lobe = Lobe::Whole) {
  Branch branch;
  branch.parent = parent;
  if (parent >= 0) branch.proximal = tree[static_cast<std::size_t>(parent)].distal;
  if (parent < 0) branch.proximal = Vec3::Zero();
  branch.distal = branch.proximal + step;
  branch.radiusMm = radiusMm;
  branch.lobe = lobe;
  return tree.add(branch);
}

/// A tree in which every branch but the last generation has two daughters that turn by the same
/// angle to both sides. Each branching plane is turned by `rotationDeg` against the one before.
struct SymmetricTree {
  int generations = 6;  ///< 2^generations - 1 branches
  std::function<double(int)> lengthMm = [](int) { return 10.0; };
  std::function<double(int)> diameterMm = [](int) { return 2.0; };
  double angleDeg = 35.0;
  double rotationDeg = 90.0;
  Lobe lobe = Lobe::Whole;

  AirwayTree tree() const {
    AirwayTree result;
    addBranch(result, -1, lengthMm(0) * -Vec3::UnitZ(), diameterMm(0) / 2.0, lobe);
    std::vector<Vec3> normal = {Vec3::UnitY()};  // of the plane in which a branch's daughters lie
    std::size_t first = 0;
    for (int generation = 1; generation < generations; ++generation) {
      const std::size_t end = result.size();
      for (std::size_t mother = first; mother < end; ++mother) {
        const Vec3 axis = normal[mother];
        for (const double sign : {1.0, -1.0}) {
          const Vec3 along = rotated(direction(result[mother]), axis, sign * radians(angleDeg));
          addBranch(result, static_cast<int>(mother), lengthMm(generation) * along,
                    diameterMm(generation) / 2.0, lobe);
          normal.push_back(rotated(axis, along, radians(rotationDeg)));
        }
      }
      first = end;
    }
    return result;
  }
};

}  // namespace pneuma::testing
