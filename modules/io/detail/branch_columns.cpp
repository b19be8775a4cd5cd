#include "io/detail/branch_columns.h"

#include "anatomy/branch_order.h"

namespace pneuma {

BranchColumns::BranchColumns(const AirwayTree& tree)
    : generation(generations(tree)),
      horsfieldOrder(horsfieldOrders(tree)),
      strahlerOrder(strahlerOrders(tree)),
      flowFraction(flowFractions(tree)),
      regionMl(servedMl(tree)),
      terminal(tree.size(), 1) {
  for (const Branch& branch : tree) {
    if (branch.parent >= 0) terminal[static_cast<std::size_t>(branch.parent)] = 0;
  }
}

}  // namespace pneuma
