#include "anatomy/branch_order.h"

#include <algorithm>

namespace pneuma {

std::vector<int> generations(const AirwayTree& tree) {
  std::vector<int> generation(tree.size(), 0);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const int parent = tree[i].parent;
    if (parent >= 0) generation[i] = generation[static_cast<std::size_t>(parent)] + 1;
  }
  return generation;
}

std::vector<int> horsfieldOrders(const AirwayTree& tree) {
  const Children children(tree);
  std::vector<int> order(tree.size(), 1);
  for (std::size_t i = tree.size(); i-- > 0;) {
    const auto ids = children.of(i);
    int highest = 0;
    for (const int child : ids) highest = std::max(highest, order[static_cast<std::size_t>(child)]);
    if (!ids.empty()) order[i] = ids.size() == 1 ? highest : highest + 1;
  }
  return order;
}

std::vector<int> strahlerOrders(const AirwayTree& tree) {
  const Children children(tree);
  std::vector<int> order(tree.size(), 1);
  for (std::size_t i = tree.size(); i-- > 0;) {
    int highest = 0;
    int withHighest = 0;
    for (const int child : children.of(i)) {
      const int childOrder = order[static_cast<std::size_t>(child)];
      if (childOrder > highest) withHighest = 0;
      highest = std::max(highest, childOrder);
      withHighest += childOrder == highest ? 1 : 0;
    }
    if (highest > 0) order[i] = withHighest > 1 ? highest + 1 : highest;
  }
  return order;
}

std::vector<double> servedMl(const AirwayTree& tree) {
  std::vector<double> served(tree.size(), 0.0);
  for (std::size_t i = tree.size(); i-- > 0;) {
    served[i] += tree[i].suppliedMl;
    if (tree[i].parent >= 0) served[static_cast<std::size_t>(tree[i].parent)] += served[i];
  }
  return served;
}

std::vector<double> flowFractions(const AirwayTree& tree) {
  double supplied = 0.0;
  for (const Branch& branch : tree) supplied += branch.suppliedMl;
  const Children children(tree);
  std::vector<double> flow(tree.size(), 0.0);
  double total = 0.0;
  for (std::size_t i = tree.size(); i-- > 0;) {
    flow[i] += supplied > 0.0 ? tree[i].suppliedMl : children.isTerminal(i) ? 1.0 : 0.0;
    if (tree[i].parent >= 0) {
      flow[static_cast<std::size_t>(tree[i].parent)] += flow[i];
    } else {
      total += flow[i];
    }
  }
  if (total > 0.0) {
    for (double& share : flow) share /= total;
  }
  return flow;
}

}  // namespace pneuma
