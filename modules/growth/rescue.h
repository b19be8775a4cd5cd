#pragma once

#include <optional>

#include "growth/cell_grid.h"
#include "growth/containment.h"

namespace pneuma {

/// Where a daughter may go: the part of its parent's region that it was given.
struct DaughterRoom {
  const Region& parent;
  const Wedge& side;
  const CellGrid& grid;   ///< lies on the parent's region
  const RowMasks& cells;  ///< of the daughter
  int count = 0;          ///< of its cells
  Containment containment = Containment::None;

  /// Is `p` in the region of the daughter?
  bool contains(const Vec3& p) const { return side.contains(p) && parent.contains(p); }

  /// The way from `p` along `direction` to the end of the daughter's region, mm.
  double exitDistance(const Vec3& p, const Vec3& direction) const;

  /// Does a branch from `from` to `to` stay inside the organ as far as was asked for?
  bool staysInside(const Vec3& from, const Vec3& to) const;
};

/// What Kitaoka 1999 lists as a shortcoming: near concave surfaces a branch leaves its region and
/// fails. It is rescued by the first of these that brings its end into its region.
enum class Rescue {
  Shortened,  ///< the same direction, half the way to the wall
  Turned,     ///< towards the centre of its region, as long as the rules said or shorter
  Reentered,  ///< to the nearest of its own cells that can be reached, whatever lies between
  LedRound,   ///< to the middle of its region by way of a point that sees both
};

struct RescuedTip {
  Vec3 tip = Vec3::Zero();
  Rescue how = Rescue::Shortened;
  std::optional<Vec3> by = {};  ///< the point that a branch led round passes
};

/// @param wanted where the rules put the daughter's end
/// @param diameterMm of the daughter; shorter than half of that is not a branch
std::optional<RescuedTip> rescuedTip(const DaughterRoom& room, const Vec3& start,
                                     const Vec3& wanted, double diameterMm);

/// The centre of what a terminal serves, or the nearest of its cells that can be reached, or by way
/// of a point that sees both.
std::optional<RescuedTip> centreTip(const DaughterRoom& room, const Vec3& start);

/// `wanted`, or part of the way there that stays inside the organ; where the wall leaves no way at
/// all, a short way back beside the parent.
/// @param parentDirection unit vector towards `start`
Vec3 insideTip(const DaughterRoom& room, const Vec3& start, const Vec3& wanted,
               const Vec3& parentDirection);

}  // namespace pneuma
