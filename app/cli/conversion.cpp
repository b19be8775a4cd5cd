#include "cli/conversion.h"

#include <algorithm>

#include "core/error.h"

namespace pneuma::cli {

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Vec3& p : mesh.points) p *= factor;
  return mesh;
}

AirwayTree scaled(const AirwayTree& tree, double factor) {
  AirwayTree result;
  result.reserve(tree.size());
  for (Branch branch : tree) {
    branch.proximal *= factor;
    branch.distal *= factor;
    branch.radiusMm *= factor;
    branch.suppliedMl *= factor * factor * factor;
    for (CentrelinePoint& point : branch.via) {
      point.position *= factor;
      point.radiusMm *= factor;
    }
    result.add(std::move(branch));
  }
  return result;
}

TriangleMesh turnedToOtherFrame(TriangleMesh mesh) {
  for (Vec3& p : mesh.points) p = Vec3(-p.x(), -p.y(), p.z());
  return mesh;
}

AirwayTree onlyLobes(const AirwayTree& tree, const std::vector<Lobe>& lobes) {
  std::vector<bool> kept(tree.size());
  for (std::size_t i = tree.size(); i-- > 0;) {
    const bool wanted = std::find(lobes.begin(), lobes.end(), tree[i].lobe) != lobes.end();
    kept[i] = kept[i] || wanted;
    if (kept[i] && tree[i].parent >= 0) kept[static_cast<std::size_t>(tree[i].parent)] = true;
  }
  if (std::find(kept.begin(), kept.end(), true) == kept.end()) {
    throw InvalidInput("the tree has no branch in the lobes that --only names");
  }
  std::vector<int> newIndex(tree.size(), -1);
  AirwayTree result;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!kept[i]) continue;
    Branch branch = tree[i];
    if (branch.parent >= 0) branch.parent = newIndex[static_cast<std::size_t>(branch.parent)];
    newIndex[i] = result.add(std::move(branch));
  }
  return result;
}

}  // namespace pneuma::cli
