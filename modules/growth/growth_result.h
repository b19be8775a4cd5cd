#pragma once

#include <string>
#include <utility>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// A particle of an aggregate.
struct AggregatePoint {
  Vec3 position;  ///< LPS, mm
  Lobe lobe = Lobe::Whole;
};

/// A grown tree and what its method has to say about how it came to be.
struct GrowthResult {
  AirwayTree tree;
  std::vector<std::pair<std::string, double>> figures;  ///< name with unit, value; in report order
  std::vector<std::string> warnings;                    ///< whole sentences
  /// What the tree was made from, in order of arrival; empty for methods that do not aggregate.
  std::vector<AggregatePoint> aggregate;
  bool endsContained = false;      ///< the options promised: no end outside its lobe
  bool branchesContained = false;  ///< the options promised: no part of a branch outside its lobe
};

}  // namespace pneuma
