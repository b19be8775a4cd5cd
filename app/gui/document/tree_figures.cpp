#include "document/tree_figures.h"

#include <algorithm>

#include "anatomy/branch_order.h"

namespace pneuma {

TreeFigures treeFigures(const AirwayTree& tree) {
  TreeFigures figures;
  figures.generation = generations(tree);
  figures.horsfieldOrder = horsfieldOrders(tree);
  figures.strahlerOrder = strahlerOrders(tree);
  figures.flowFraction = flowFractions(tree);
  figures.pathMm.resize(tree.size());
  const Children children(tree);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Branch& branch = tree[i];
    const double above =
        branch.parent < 0 ? 0.0 : figures.pathMm[static_cast<std::size_t>(branch.parent)];
    figures.pathMm[i] = above + lengthMm(branch);
    const auto generation = static_cast<std::size_t>(figures.generation[i]);
    if (figures.branchesOfGeneration.size() <= generation) {
      figures.branchesOfGeneration.resize(generation + 1);
    }
    ++figures.branchesOfGeneration[generation];
    ++figures.branchesIn[branch.lobe];
    if (branch.origin == Origin::Grown) ++figures.grown;
    if (children.isTerminal(i)) {
      ++figures.terminals;
      ++figures.terminalsIn[branch.lobe];
    }
  }
  return figures;
}

std::size_t neighbour(const AirwayTree& tree, std::size_t branch, Neighbour which) {
  const int parent = tree[branch].parent;
  if (which == Neighbour::Parent) return parent < 0 ? branch : static_cast<std::size_t>(parent);

  const int kin = which == Neighbour::Child ? static_cast<int>(branch) : parent;
  std::vector<std::size_t> family;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i].parent == kin) family.push_back(i);
  }
  if (family.empty()) return branch;
  if (which == Neighbour::Child) {
    return *std::max_element(family.begin(), family.end(), [&](std::size_t a, std::size_t b) {
      return tree[a].radiusMm < tree[b].radiusMm;
    });
  }
  const auto self = std::find(family.begin(), family.end(), branch);
  if (which == Neighbour::NextSibling)
    return self + 1 == family.end() ? family.front() : *(self + 1);
  return self == family.begin() ? family.back() : *(self - 1);
}

}  // namespace pneuma
