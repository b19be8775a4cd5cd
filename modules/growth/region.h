#pragma once

#include <vector>

#include "core/domain.h"
#include "growth/row_kernels.h"

namespace pneuma {

/// One side of a space-dividing plane (rule 4), or of two half-planes that meet at a branching
/// point (rule 4a). LPS, mm.
struct Wedge {
  WedgeKind kind = WedgeKind::Plane;
  Vec3 point = Vec3::Zero();   ///< a point of the plane; with two, of the line where they meet
  Vec3 first = Vec3::UnitX();  ///< normals that point inside
  Vec3 second = Vec3::Zero();  ///< unused for one plane

  bool contains(const Vec3& p) const;

  /// The way from `p` along the unit vector `direction` until the wedge is left, mm: 0 outside,
  /// infinite if it is never left. `p` may lie on the boundary.
  double exitDistance(const Vec3& p, const Vec3& direction) const;

  /// Everything else.
  Wedge rest() const;
};

/// A branch as the space it takes.
struct Capsule {
  Vec3 start = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  double radiusMm = 0.0;
};

/// The part of an organ that one branch serves: what lies in all `walls` and in no ancestor.
struct Region {
  const Domain* organ = nullptr;
  double organFlow = 1.0;          ///< share of the whole flow that the organ takes
  Box3 box;                        ///< holds the region
  bool organCuts = true;           ///< false once the box lies wholly inside the organ
  std::vector<Wedge> walls;        ///< of all divisions so far
  std::vector<Wedge> cuts;         ///< those of them that cut the box
  std::vector<Capsule> ancestors;  ///< those that touch the box

  /// Is `p` inside the organ and all walls? Ancestors do not count (rule 9).
  bool contains(const Vec3& p) const;

  /// The way from `p` along `direction` to the first wall or out of the organ, mm. Ancestors do not
  /// count (rule 7a).
  double exitDistance(const Vec3& p, const Vec3& direction) const;
};

}  // namespace pneuma
