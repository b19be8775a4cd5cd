#pragma once

#include <string>
#include <utility>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// A grown tree and what its method has to say about how it came to be.
struct GrowthResult {
  AirwayTree tree;
  std::vector<std::pair<std::string, double>> figures;  ///< name with unit, value; in report order
  std::vector<std::string> warnings;                    ///< whole sentences
  bool endsContained = false;      ///< the options promised: no end outside its lobe
  bool branchesContained = false;  ///< the options promised: no part of a branch outside its lobe
};

}  // namespace pneuma
