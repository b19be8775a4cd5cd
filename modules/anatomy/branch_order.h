#pragma once

#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// Branches between every branch and the root: 0 for the trachea. One-daughter steps count
/// (Huang 2004); contract the chains first where they should not.
std::vector<int> generations(const AirwayTree& tree);

/// Horsfield order: 1 at the terminals, otherwise one more than the highest order of the children.
/// A branch with one child has the child's order.
std::vector<int> horsfieldOrders(const AirwayTree& tree);

/// Strahler order: 1 at the terminals; rises only where two children share the highest order.
std::vector<int> strahlerOrders(const AirwayTree& tree);

/// Lung that every branch serves, at its own end and through its children, ml.
std::vector<double> servedMl(const AirwayTree& tree);

/// Share of the whole flow through every branch, in [0, 1]: the volume supplied below it, or the
/// number of terminals below it where no branch says what it supplies. 1 at the root.
std::vector<double> flowFractions(const AirwayTree& tree);

}  // namespace pneuma
