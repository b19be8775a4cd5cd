#pragma once

#include <optional>

#include "growth/cell_grid.h"
#include "growth/kitaoka_rules.h"

namespace pneuma {

/// A branch as its division sees it.
struct Stem {
  Vec3 tip = Vec3::Zero();           ///< the branching point, LPS, mm
  Vec3 direction = -Vec3::UnitZ();   ///< unit vector towards the tip
  Vec3 planeNormal = Vec3::UnitX();  ///< of the branching plane in which it was born, unit vector
  double flow = 1.0;                 ///< share of the whole
};

/// The part of `normal` that is normal to `direction`, a unit vector.
Vec3 acrossOf(const Vec3& normal, const Vec3& direction);

/// How the region of a branch is divided between its daughters a and b.
struct Division {
  Vec3 towardsA = Vec3::UnitX();  ///< in the branching plane, normal to the parent
  Wedge sideA;                    ///< b has the rest
  double shareA = 0.5;            ///< of the parent's cells
  BranchingAngles angles;         ///< of Eq. 6
  Vec3 normal = Vec3::UnitZ();    ///< of the branching plane, unit vector
  double rotationDeg = 90.0;      ///< realised rotation angle of the branching plane
  bool turned = false;            ///< by rule 8a
  bool rescued = false;           ///< bent further than rule 4a would, for no rotation was enough

  double smallerShare() const { return shareA < 0.5 ? shareA : 1.0 - shareA; }
};

/// The half-planes of rule 4a as the side of a: the plane through the parent's axis behind the tip,
/// and from the tip the half-plane at `bend` to the parent's direction, towards a.
Wedge rule4aSide(const Stem& stem, const Vec3& towardsA, const Turn& bend);

/// Rules 4, 4a, 5, 6, 8 and 8a: the division of the region on which `grid` lies.
/// @param rotationDeg where rule 8a begins: options.rotationDeg, with its random change
/// @return none if no rotation gives the smaller daughter its least share (and nothing rescues it)
std::optional<Division> divide(const CellGrid& grid, const Stem& stem, double rotationDeg,
                               const KitaokaOptions& options);

/// Beyond the paper: a plane through the middle of the region on which `grid` lies, across the way
/// to its farthest cell. None if all cells lie on one side.
std::optional<Division> halve(const CellGrid& grid, const Stem& stem);

/// Rule 6a's angle: the half-plane through the branching point, normal to the branching plane, that
/// halves the cells of a daughter.
/// @param side of the daughter
/// @param towards the daughter's unit vector in the branching plane, normal to the parent
/// @param angle where to begin: the branching angle of Eq. 6
/// @return `angle` if at least half of the cells lie below it; at most 180 degrees less `angle`
Turn bisectingAngle(const CellGrid& grid, const RowMasks& cells, int count, const Stem& stem,
                    const Wedge& side, const Vec3& towards, const Turn& angle);

}  // namespace pneuma
