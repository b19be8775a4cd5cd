#pragma once

#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// What files tell of every branch beside its geometry; computed once for a tree.
struct BranchColumns {
  std::vector<int> generation;
  std::vector<int> horsfieldOrder;
  std::vector<int> strahlerOrder;
  std::vector<double> flowFraction;
  std::vector<double> regionMl;  ///< lung served at and below the branch
  std::vector<char> terminal;    ///< 1 for a branch without children

  explicit BranchColumns(const AirwayTree& tree);
};

}  // namespace pneuma
