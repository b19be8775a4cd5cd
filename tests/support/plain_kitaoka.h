#pragma once

#include "anatomy/airway_tree.h"
#include "core/domain.h"

/// Kitaoka's rules as one reads them, one cell after the other: the reference for the engine in
/// modules/growth, with which it shares no code. All rules on, the paper's parameters.
namespace pneuma::testing {

struct PlainTree {
  std::size_t branches = 0;  ///< with the trunk
  std::size_t terminals = 0;
  double failedFlow = 0.0;             ///< Q_f
  double terminalFlowVariation = 0.0;  ///< C_a
  double airwayVolumeMl = 0.0;
  double generation = 0.0;        ///< mean over terminals, the trunk is 0
  double lengthToDiameter = 0.0;  ///< mean over grown branches
};

/// @param trunk from which everything grows; @param widest the first branching plane contains it
PlainTree growPlainly(const Domain& organ, const Branch& trunk, const Vec3& widest,
                      double flowThreshold);

}  // namespace pneuma::testing
