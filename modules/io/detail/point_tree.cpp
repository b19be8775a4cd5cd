#include "io/detail/point_tree.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "io/detail/parent_order.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

using Node = PointTree::Node;

int rootOf(const std::vector<Node>& nodes, const std::string& name) {
  int root = -1;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent >= 0) continue;
    if (root >= 0) {
      throw InvalidInput(name + " has two roots, at " +
                         pointText(nodes[static_cast<std::size_t>(root)].position) + " and at " +
                         pointText(nodes[i].position) +
                         "; an airway tree has one, so keep one tree in the file");
    }
    root = static_cast<int>(i);
  }
  if (root < 0) {
    throw InvalidInput(name +
                       " has no root, so its points run in a cycle; an airway tree has none");
  }
  return root;
}

std::vector<int> orderOf(const std::vector<Node>& nodes, const std::string& name) {
  std::vector<int> parents(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) parents[i] = nodes[i].parent;
  std::vector<int> order = parentsFirst(parents);
  if (order.size() < nodes.size()) {
    throw InvalidInput(name + " has a cycle: " + std::to_string(nodes.size() - order.size()) +
                       " points do not lead back to the root; an airway tree has no cycle");
  }
  return order;
}

/// Mean radius by length along the nodes from the start to the end of a branch, mm.
double meanRadiusMm(const std::vector<Node>& nodes, const std::vector<int>& along) {
  double length = 0.0;
  double sum = 0.0;
  for (std::size_t i = 1; i < along.size(); ++i) {
    const Node& a = nodes[static_cast<std::size_t>(along[i - 1])];
    const Node& b = nodes[static_cast<std::size_t>(along[i])];
    const double step = (b.position - a.position).norm();
    length += step;
    sum += step * 0.5 * (a.radiusMm + b.radiusMm);
  }
  return length > 0.0 ? sum / length : nodes[static_cast<std::size_t>(along.back())].radiusMm;
}

}  // namespace

AirwayTree treeOfPoints(const PointTree& points, const std::string& name) {
  const std::vector<Node>& nodes = points.nodes;
  if (nodes.size() < 2) {
    throw InvalidInput(name + " holds fewer than two joined points, so no airway; is it complete?");
  }
  const int root = rootOf(nodes, name);
  std::vector<int> childCount(nodes.size(), 0);
  for (const Node& node : nodes) {
    if (node.parent >= 0) ++childCount[static_cast<std::size_t>(node.parent)];
  }
  const std::vector<int> order = orderOf(nodes, name);
  if (childCount[static_cast<std::size_t>(root)] > 1) {
    throw InvalidInput(name + " divides at its very first point, " +
                       pointText(nodes[static_cast<std::size_t>(root)].position) +
                       "; an airway tree begins with one airway, so add the trachea");
  }
  AirwayTree tree;
  std::vector<int> branchEndingAt(nodes.size(), -1);
  std::vector<int> along;  // nodes of the branch at hand, from its start to its end
  for (const int end : order) {
    const auto endIndex = static_cast<std::size_t>(end);
    if (end == root || (childCount[endIndex] == 1 && !nodes[endIndex].endsBranch)) continue;
    along.assign(1, end);
    do {
      along.push_back(nodes[static_cast<std::size_t>(along.back())].parent);
    } while (along.back() != root && branchEndingAt[static_cast<std::size_t>(along.back())] < 0);
    std::reverse(along.begin(), along.end());
    const auto startIndex = static_cast<std::size_t>(along.front());

    Branch branch;
    branch.parent = branchEndingAt[startIndex];
    branch.proximal = nodes[startIndex].position;
    branch.distal = nodes[endIndex].position;
    branch.radiusMm =
        points.endRadiusIsBranchRadius ? nodes[endIndex].radiusMm : meanRadiusMm(nodes, along);
    branch.lobe = nodes[endIndex].lobe;
    branch.origin = nodes[endIndex].origin;
    branch.via.reserve(along.size() - 2);
    for (std::size_t i = 1; i + 1 < along.size(); ++i) {
      const Node& node = nodes[static_cast<std::size_t>(along[i])];
      branch.via.push_back({node.position, node.radiusMm});
    }
    branchEndingAt[endIndex] = tree.add(std::move(branch));
  }
  return tree;
}

}  // namespace pneuma
