#include "anatomy/branching_angles.h"

#include <algorithm>
#include <numbers>

#include "anatomy/branch_order.h"

namespace pneuma {
namespace {

std::vector<Vec3> directions(const AirwayTree& tree) {
  std::vector<Vec3> result;
  result.reserve(tree.size());
  for (const Branch& branch : tree) result.push_back(direction(branch));
  return result;
}

}  // namespace

std::vector<BranchingAngle> branchingAngles(const AirwayTree& tree) {
  const Children children(tree);
  const std::vector<Vec3> direction = directions(tree);
  const std::vector<double> flow = flowFractions(tree);
  const auto isNarrower = [&](int a, int b) {
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    return tree[i].radiusMm != tree[j].radiusMm ? tree[i].radiusMm < tree[j].radiusMm
                                                : flow[i] < flow[j];
  };
  std::vector<BranchingAngle> angles;
  angles.reserve(tree.size());
  for (std::size_t mother = 0; mother < tree.size(); ++mother) {
    const auto daughters = children.of(mother);
    if (daughters.size() < 2 || direction[mother].isZero()) continue;
    const int major = *std::ranges::max_element(daughters, isNarrower);
    for (const int id : daughters) {
      const auto daughter = static_cast<std::size_t>(id);
      if (direction[daughter].isZero()) continue;
      angles.push_back(
          {daughter, angleBetween(direction[mother], direction[daughter]), id == major});
    }
  }
  return angles;
}

std::vector<RotationAngle> rotationAngles(const AirwayTree& tree) {
  constexpr double SmallestSine = 1e-6;  // of the angle between daughters that still span a plane
  const Children children(tree);
  const std::vector<Vec3> direction = directions(tree);
  std::vector<Vec3> normal(tree.size(), Vec3::Zero());  // of the fork at the end of every branch
  std::vector<int> forkAbove(tree.size(), -1);
  std::vector<RotationAngle> angles;
  angles.reserve(tree.size() / 2);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i].parent >= 0) {
      const auto parent = static_cast<std::size_t>(tree[i].parent);
      forkAbove[i] = children.of(parent).size() > 1 ? tree[i].parent : forkAbove[parent];
    }
    const auto daughters = children.of(i);
    if (daughters.size() != 2) continue;
    const Vec3 cross = direction[static_cast<std::size_t>(daughters[0])].cross(
        direction[static_cast<std::size_t>(daughters[1])]);
    if (cross.norm() < SmallestSine) continue;
    normal[i] = cross.normalized();
    if (forkAbove[i] < 0) continue;
    const Vec3& above = normal[static_cast<std::size_t>(forkAbove[i])];
    if (above.isZero()) continue;
    const double angle = angleBetween(above, normal[i]);
    angles.push_back({i, std::min(angle, std::numbers::pi - angle)});
  }
  return angles;
}

}  // namespace pneuma
