#include "anatomy/airway_tree.h"

#include <string>

#include "core/error.h"

namespace pneuma {

double lengthMm(const Branch& branch) {
  double length = 0.0;
  const Vec3* last = &branch.proximal;
  for (const CentrelinePoint& point : branch.via) {
    length += (point.position - *last).norm();
    last = &point.position;
  }
  return length + (branch.distal - *last).norm();
}

Vec3 direction(const Branch& branch) {
  const Vec3 along = branch.distal - branch.proximal;
  const double length = along.norm();
  return length > 0.0 ? Vec3(along / length) : Vec3::Zero();
}

int AirwayTree::add(Branch branch) {
  if (branch.parent < -1 || branch.parent >= static_cast<int>(branches_.size())) {
    throw InvalidInput("branch " + std::to_string(branches_.size()) + " names branch " +
                       std::to_string(branch.parent) +
                       " as its parent, but parents come before their children");
  }
  branches_.push_back(std::move(branch));
  return static_cast<int>(branches_.size()) - 1;
}

Children::Children(const AirwayTree& tree)
    : offsets_(tree.size() + 1, 0), ids_(tree.empty() ? 0 : tree.size()) {
  for (const Branch& branch : tree) {
    if (branch.parent >= 0) ++offsets_[static_cast<std::size_t>(branch.parent) + 1];
  }
  for (std::size_t i = 0; i < tree.size(); ++i) offsets_[i + 1] += offsets_[i];
  std::vector<int> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const int parent = tree[i].parent;
    if (parent >= 0) {
      ids_[static_cast<std::size_t>(next[static_cast<std::size_t>(parent)]++)] =
          static_cast<int>(i);
    }
  }
}

std::size_t terminalCount(const AirwayTree& tree) {
  const Children children(tree);
  std::size_t count = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) count += children.isTerminal(i) ? 1 : 0;
  return count;
}

AirwayTree contractChains(const AirwayTree& tree) {
  const Children children(tree);
  AirwayTree result;
  result.reserve(tree.size());
  std::vector<int> newIndex(tree.size(), -1);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const int parent = tree[i].parent;
    const bool startsChain =
        parent < 0 || children.of(static_cast<std::size_t>(parent)).size() != 1;
    if (!startsChain) continue;
    Branch joined = tree[i];
    joined.parent = parent < 0 ? -1 : newIndex[static_cast<std::size_t>(parent)];
    double length = lengthMm(joined);
    double weightedRadius = length * joined.radiusMm;
    std::size_t last = i;
    while (children.of(last).size() == 1) {
      const std::size_t next = static_cast<std::size_t>(children.of(last)[0]);
      const Branch& part = tree[next];
      joined.via.push_back({joined.distal, tree[last].radiusMm});
      joined.via.insert(joined.via.end(), part.via.begin(), part.via.end());
      joined.distal = part.distal;
      joined.lobe = part.lobe;
      joined.segment = part.segment;
      joined.origin = part.origin;
      joined.ending = part.ending;
      joined.suppliedMl += part.suppliedMl;
      const double partLength = lengthMm(part);
      weightedRadius += partLength * part.radiusMm;
      length += partLength;
      last = next;
    }
    if (length > 0.0) joined.radiusMm = weightedRadius / length;
    newIndex[last] = result.add(std::move(joined));
  }
  return result;
}

}  // namespace pneuma
