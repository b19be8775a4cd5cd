#include "growth/rescue.h"

#include <algorithm>

namespace pneuma {
namespace {

/// The middle of the daughter's region: its cells' mean, or the cell nearest to that.
Vec3 middleOf(const DaughterRoom& room) {
  const Vec3 centre = room.grid.centroidOf(room.cells);
  if (room.contains(centre)) return centre;
  return room.grid.nearestCentre(room.cells, centre, [](const Vec3&) { return true; })
      .value_or(centre);
}

/// The way to the middle of the region by way of a point that sees both, the one nearest to the
/// middle.
std::optional<RescuedTip> ledRound(const DaughterRoom& room, const Vec3& start) {
  const Vec3 middle = middleOf(room);
  Box3 box = room.grid.boxOf(room.cells);
  box.extend(start);
  const Vec3 margin = 0.25 * box.sizes();
  Region around;
  around.organ = room.parent.organ;
  around.box = Box3(box.min() - margin, box.max() + margin).intersection(around.organ->bounds());
  CellGrid grid(room.grid.cellsAcross());
  if (grid.lay(around) == 0) return std::nullopt;
  const std::optional<Vec3> by = grid.nearestCentre(grid.cells(), middle, [&](const Vec3& point) {
    return point != start && point != middle && room.staysInside(start, point) &&
           room.staysInside(point, middle);
  });
  if (!by.has_value()) return std::nullopt;
  return RescuedTip{middle, Rescue::LedRound, by};
}

}  // namespace

double DaughterRoom::exitDistance(const Vec3& p, const Vec3& direction) const {
  const double ownWall = side.exitDistance(p, direction);
  return ownWall <= 0.0 ? 0.0 : std::min(ownWall, parent.exitDistance(p, direction));
}

bool DaughterRoom::staysInside(const Vec3& from, const Vec3& to) const {
  if (containment == Containment::None) return true;
  if (!parent.organCuts && parent.box.contains(from) && parent.box.contains(to)) return true;
  return containment == Containment::Ends ? parent.organ->contains(to)
                                          : parent.organ->containsSegment(from, to);
}

std::optional<RescuedTip> rescuedTip(const DaughterRoom& room, const Vec3& start,
                                     const Vec3& wanted, double diameterMm) {
  const double length = (wanted - start).norm();
  const double leastMm = 0.5 * diameterMm;
  const auto serves = [&](const Vec3& tip) {
    return (tip - start).norm() >= leastMm && room.contains(tip) && room.staysInside(start, tip);
  };
  const Vec3 direction = (wanted - start) / length;
  const Vec3 shortened =
      start + std::min(length, 0.5 * room.exitDistance(start, direction)) * direction;
  if (serves(shortened)) return RescuedTip{shortened, Rescue::Shortened};
  if (room.count == 0) return std::nullopt;

  const Vec3 centre = room.grid.centroidOf(room.cells);
  const double toCentre = (centre - start).norm();
  for (const double part : {1.0, 0.75, 0.5}) {
    const Vec3 tip = start + (centre - start) * std::min(1.0, part * length / toCentre);
    if (serves(tip)) return RescuedTip{tip, Rescue::Turned};
  }
  const std::optional<Vec3> cell = room.grid.nearestCentre(room.cells, start, serves);
  if (cell.has_value()) return RescuedTip{*cell, Rescue::Reentered};
  return ledRound(room, start);
}

std::optional<RescuedTip> centreTip(const DaughterRoom& room, const Vec3& start) {
  if (room.count == 0) return std::nullopt;
  const auto serves = [&](const Vec3& tip) {
    return tip != start && room.contains(tip) && room.staysInside(start, tip);
  };
  const Vec3 centre = room.grid.centroidOf(room.cells);
  if (serves(centre)) return RescuedTip{centre, Rescue::Turned};
  const std::optional<Vec3> cell = room.grid.nearestCentre(room.cells, centre, serves);
  if (cell.has_value()) return RescuedTip{*cell, Rescue::Reentered};
  return ledRound(room, start);
}

Vec3 insideTip(const DaughterRoom& room, const Vec3& start, const Vec3& wanted,
               const Vec3& parentDirection) {
  if (room.staysInside(start, wanted)) return wanted;
  constexpr int MostTrials = 20;
  constexpr double LeastMm = 0.05;
  const double length = (wanted - start).norm();
  for (const Vec3& direction : {Vec3((wanted - start) / length), Vec3(-parentDirection)}) {
    double reach = 0.7 * room.parent.organ->exitDistance(start, direction, length);
    for (int trial = 0; trial < MostTrials && reach > LeastMm; ++trial) {
      const Vec3 tip = start + reach * direction;
      if (room.staysInside(start, tip)) return tip;
      reach *= 0.7;
    }
  }
  return start - LeastMm * parentDirection;
}

}  // namespace pneuma
