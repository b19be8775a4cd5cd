#pragma once

#include <numbers>

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

/// Sum of the cones between the points of the centreline, mm^3.
inline double airwayVolumeMm3(const Branch& branch) {
  double volume = 0.0;
  forEachPiece(branch, [&](const CentrelinePiece& piece) {
    const double r = piece.fromRadiusMm;
    const double s = piece.toRadiusMm;
    volume += (piece.to - piece.from).norm() * (r * r + r * s + s * s) * std::numbers::pi / 3.0;
  });
  return volume;
}

}  // namespace pneuma
