#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// What the window shows of every branch; computed once for a tree, away from the GUI thread.
struct TreeFigures {
  std::vector<int> generation;
  std::vector<int> horsfieldOrder;
  std::vector<int> strahlerOrder;
  std::vector<double> flowFraction;
  std::vector<double> pathMm;  ///< along the airways from the root's proximal to the distal end
  std::vector<std::size_t> branchesOfGeneration;
  std::map<Lobe, std::size_t> branchesIn;
  std::map<Lobe, std::size_t> terminalsIn;
  std::size_t grown = 0;
  std::size_t terminals = 0;
};

TreeFigures treeFigures(const AirwayTree& tree);

/// Where the keyboard can go from a branch.
enum class Neighbour { Parent, Child, PreviousSibling, NextSibling };

/// The branch next to `branch`, or `branch` itself where there is none. The child is the widest
/// one.
std::size_t neighbour(const AirwayTree& tree, std::size_t branch, Neighbour which);

}  // namespace pneuma
