#pragma once

#include <vector>

#include "anatomy/lobe.h"
#include "core/triangle_mesh.h"
#include "pipeline/sample_lung.h"

namespace pneuma {

/// The values that tell the lobes of a lung apart at a point, each positive on one side.
struct LungLevels {
  double pleura = 0.0;
  double aboveOblique = 0.0;
  double aboveHorizontal = 0.0;
};

LungLevels levelsAt(const SampleLung& shape, const Vec3& lps);

/// Positive inside the lobe or whole lung, 0 on its wall. The two sides of a fissure are exact
/// negatives, so that surfaces made of them meet in the same points.
double levelIn(Lobe lobe, const LungLevels& at);

/// A lattice over a lung of the sample chest with the levels at its nodes.
class LungLattice {
 public:
  LungLattice(const SampleLung& shape, double cellMm);

  /// mm^3, by the nodes inside.
  double volumeMm3(Lobe lobe) const;

  TriangleMesh surface(Lobe lobe) const;

 private:
  LungLevels awayFromZero(const LungLevels& at) const;
  void joinCrumbs();
  void give(std::size_t node, Lobe lobe);
  Lobe lobeAt(std::size_t node) const;

  Side side_;
  double cellMm_;
  double leastLevel_;  ///< keeps the wall a little off the nodes: no triangle without area
  Vec3 origin_;
  Eigen::Vector3i size_;
  std::vector<LungLevels> levels_;
};

}  // namespace pneuma
