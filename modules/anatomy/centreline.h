#pragma once

#include "anatomy/airway_tree.h"

namespace pneuma {

/// A straight piece of a branch's centreline with the airway's radius at both of its ends.
struct CentrelinePiece {
  Vec3 from;  ///< LPS, mm
  Vec3 to;
  double fromRadiusMm = 0.0;
  double toRadiusMm = 0.0;
};

/// Calls `f(piece)` for every piece of the branch, proximal to distal. A branch without `via` is
/// one piece. The ends of a measured branch have no radius of their own: they take that of the
/// nearest measured point.
template <class F>
void forEachPiece(const Branch& branch, F&& f) {
  const auto& via = branch.via;
  Vec3 from = branch.proximal;
  double radius = via.empty() ? branch.radiusMm : via.front().radiusMm;
  for (const CentrelinePoint& point : via) {
    f(CentrelinePiece{from, point.position, radius, point.radiusMm});
    from = point.position;
    radius = point.radiusMm;
  }
  f(CentrelinePiece{from, branch.distal, radius, radius});
}

}  // namespace pneuma
