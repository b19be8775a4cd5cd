#include "growth/inlet_regions.h"

#include <algorithm>
#include <functional>
#include <string>

#include "core/error.h"

namespace pneuma {
namespace {

/// The inlets of one lobe and the way down to them.
class LobeDivider {
 public:
  LobeDivider(const AirwayTree& central, std::span<const Inlet> inlets, std::size_t region,
              const KitaokaOptions& options, std::vector<Sprout>& sprouts)
      : central_(central),
        children_(central),
        inletOf_(central.size(), -1),
        below_(central.size(), Vec3::Zero()),
        inletsBelow_(central.size(), 0),
        grid_(options.grid),
        sprouts_(sprouts) {
    for (std::size_t i = 0; i < inlets.size(); ++i) {
      if (inlets[i].region == region) inletOf_[inlets[i].branch] = static_cast<int>(i);
    }
    for (std::size_t i = central.size(); i-- > 0;) {
      if (inletOf_[i] >= 0) {
        below_[i] += central[i].distal;
        ++inletsBelow_[i];
      }
      if (central[i].parent < 0) continue;
      const auto parent = static_cast<std::size_t>(central[i].parent);
      below_[parent] += below_[i];
      inletsBelow_[parent] += inletsBelow_[i];
    }
  }

  void descend(std::size_t branch, Sprout sprout) {
    std::vector<std::size_t> ways;
    for (const int child : children_.of(branch)) {
      if (inletsBelow_[static_cast<std::size_t>(child)] > 0) {
        ways.push_back(static_cast<std::size_t>(child));
      }
    }
    if (ways.empty()) {
      sprouts_[static_cast<std::size_t>(inletOf_[branch])] = std::move(sprout);
      return;
    }
    divideAmong(ways, std::move(sprout));
  }

 private:
  /// Where a way leads, from the branching point: a template's own direction, and of measured
  /// airways, whose first millimetres may point anywhere, the middle of the inlets below.
  Vec3 aimOf(std::size_t way, const Vec3& from) const {
    const Branch& branch = central_[way];
    if (branch.origin == Origin::Template) return direction(branch);
    const Vec3 aim = below_[way] / static_cast<double>(inletsBelow_[way]) - from;
    return aim.norm() > 0.0 ? Vec3(aim.normalized()) : direction(branch);
  }

  Vec3 aimOf(std::span<const std::size_t> ways, const Vec3& from) const {
    if (ways.size() == 1) return aimOf(ways[0], from);
    Vec3 aim = Vec3::Zero();
    for (const std::size_t way : ways) {
      aim += static_cast<double>(inletsBelow_[way]) * aimOf(way, from);
    }
    return aim.norm() > 1e-9 ? Vec3(aim.normalized()) : aimOf(ways[0], from);
  }

  /// Splits off one way after the other until each has its own region.
  void divideAmong(std::span<const std::size_t> ways, Sprout sprout) {
    if (ways.size() == 1) {
      const Branch& branch = central_[ways[0]];
      sprout.stem.tip = branch.distal;
      sprout.stem.direction = direction(branch);
      sprout.stem.planeNormal = acrossOf(sprout.stem.planeNormal, sprout.stem.direction);
      sprout.region.ancestors.push_back({branch.proximal, branch.distal, branch.radiusMm});
      descend(ways[0], std::move(sprout));
      return;
    }
    const std::span<const std::size_t> others = ways.subspan(1);
    const Vec3 from = sprout.stem.tip;
    const Wedge side = givenSide(sprout.stem, aimOf(ways[0], from), aimOf(others, from));
    RowMasks cellsA;
    RowMasks cellsB;
    const bool room = sprout.stem.flow > 0.0 && grid_.lay(sprout.region) > 0;
    if (room) {
      grid_.select(side, grid_.cells(), cellsA);
      grid_.selectRest(cellsA, cellsB);
    }
    const Vec3 normal = sprout.stem.direction.cross(side.first).normalized();
    Sprout rest = partOf(sprout, room, side.rest(), cellsB, normal);
    divideAmong(ways.first(1), partOf(sprout, room, side, cellsA, normal));
    divideAmong(others, std::move(rest));
  }

  /// The region's part on one side, still at the parent's branching point.
  Sprout partOf(const Sprout& parent, bool room, const Wedge& side, const RowMasks& cells,
                const Vec3& normal) const {
    Sprout part = parent;
    part.stem.planeNormal = normal;
    part.region.walls.push_back(side);
    part.region.cuts.push_back(side);
    const int count = room ? grid_.countAll(cells) : 0;
    part.stem.flow = room ? parent.stem.flow * count / grid_.count() : 0.0;
    if (count > 0) part.region.box = grid_.boxOf(cells);
    return part;
  }

  const AirwayTree& central_;
  Children children_;
  std::vector<int> inletOf_;
  std::vector<Vec3> below_;  ///< sum of the inlets' ends
  std::vector<int> inletsBelow_;
  CellGrid grid_;
  std::vector<Sprout>& sprouts_;
};

/// The normal from which the first branching plane, turned by the rotation angle, contains the
/// direction along which the organ is widest.
Vec3 firstNormal(const Box3& box, const Vec3& direction, double rotationDeg) {
  const Turn rotation = Turn::ofDegrees(rotationDeg);
  const Vec3 widest = widestAcross(box, direction);
  return rotation.sine * widest - rotation.cosine * widest.cross(direction);
}

/// The only inlet of a lobe must lead somewhere. @pre `grid` lies on the whole lobe
void requireTrunkPointsIn(const AirwayTree& central, std::span<const Inlet> inlets,
                          std::size_t region, const LobeRegion& lobe, const CellGrid& grid) {
  if (std::ranges::count(inlets, region, &Inlet::region) != 1) return;
  const Branch& trunk = central[std::ranges::find(inlets, region, &Inlet::region)->branch];
  const int ahead = grid.countIn({WedgeKind::Plane, trunk.distal, direction(trunk), Vec3::Zero()});
  if (ahead > 0.01 * grid.count()) return;
  throw InvalidInput("the airway that enters the " + std::string(longName(lobe.lobe)) +
                     " points out of it: nothing of the lobe lies ahead of its end; turn it round, "
                     "or end it further in");
}

/// Is the lobe divided by distance, not by bifurcations?
bool servesNearest(const AirwayTree& central, std::span<const Inlet> inlets, std::size_t region,
                   const KitaokaOptions& options) {
  if (options.inletRegions != InletRegions::Auto) {
    return options.inletRegions == InletRegions::Nearest;
  }
  return std::ranges::any_of(inlets, [&](const Inlet& inlet) {
    return inlet.region == region && central[inlet.branch].origin == Origin::Measured;
  });
}

/// Lays the grid on `region` again and again as its box shrinks to what it holds.
void tighten(CellGrid& grid, Region& region) {
  constexpr int Rounds = 3;
  for (int round = 0; round < Rounds; ++round) {
    if (grid.lay(region) == 0) return;
    region.box = grid.boxOf(grid.cells());
  }
  grid.lay(region);
}

/// Gives every inlet of a lobe what is nearer to its end than to that of any other.
void giveNearest(const AirwayTree& central, std::span<const Inlet> inlets, std::size_t region,
                 const Sprout& whole, CellGrid& grid, std::vector<Sprout>& sprouts) {
  double flow = 0.0;
  for (std::size_t i = 0; i < inlets.size(); ++i) {
    if (inlets[i].region != region) continue;
    const Branch& branch = central[inlets[i].branch];
    Sprout& sprout = sprouts[i];
    sprout = whole;
    sprout.stem.tip = branch.distal;
    sprout.stem.direction = direction(branch);
    const Vec3 before = branch.parent < 0
                            ? Vec3(Vec3::Zero())
                            : direction(central[static_cast<std::size_t>(branch.parent)]);
    const Vec3 normal = before.cross(sprout.stem.direction);
    sprout.stem.planeNormal = normal.norm() > 1e-6
                                  ? Vec3(normal.normalized())
                                  : widestAcross(whole.region.box, sprout.stem.direction);
    sprout.region.ancestors.clear();
    for (int above = static_cast<int>(inlets[i].branch); above >= 0;) {
      const Branch& ancestor = central[static_cast<std::size_t>(above)];
      sprout.region.ancestors.push_back({ancestor.proximal, ancestor.distal, ancestor.radiusMm});
      above = ancestor.parent;
    }
    for (const Inlet& other : inlets) {
      if (other.region != region || other.branch == inlets[i].branch) continue;
      const Vec3 apart = branch.distal - central[other.branch].distal;
      if (apart.norm() <= 0.0) continue;  // two that end at the same point share
      sprout.region.walls.push_back({WedgeKind::Plane,
                                     (branch.distal + central[other.branch].distal) / 2.0,
                                     apart.normalized(), Vec3::Zero()});
    }
    sprout.region.cuts = sprout.region.walls;
    tighten(grid, sprout.region);
    sprout.stem.flow = grid.count() * grid.cellMm3();
    flow += sprout.stem.flow;
  }
  for (std::size_t i = 0; i < inlets.size(); ++i) {
    if (inlets[i].region == region) sprouts[i].stem.flow *= whole.stem.flow / flow;
  }
}

}  // namespace

Wedge givenSide(const Stem& stem, const Vec3& directionA, const Vec3& directionB) {
  const Vec3 apart = directionA - directionB;
  const Vec3 across = apart - apart.dot(stem.direction) * stem.direction;
  const Vec3 towardsA =
      across.norm() > 1e-9 ? Vec3(across.normalized()) : anyPerpendicular(stem.direction);
  const Turn a = Turn::ofCosine(directionA.dot(stem.direction));
  const Turn b = Turn::ofCosine(directionB.dot(stem.direction));
  return rule4aSide(stem, towardsA, a.minus(b).half());
}

Vec3 widestAcross(const Box3& box, const Vec3& direction) {
  Vec3 widest = anyPerpendicular(direction);
  double width = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = Vec3::Unit(axis);
    const Vec3 across = along - along.dot(direction) * direction;
    const double seen = box.sizes()[axis] * across.norm();
    if (across.norm() > 0.5 && seen > width * (1.0 + 1e-9)) {
      width = seen;
      widest = across.normalized();
    }
  }
  return widest;
}

std::vector<Sprout> inletSprouts(const AirwayTree& central, std::span<const Inlet> inlets,
                                 std::span<const LobeRegion> lobes, const KitaokaOptions& options) {
  double volume = 0.0;
  for (const LobeRegion& lobe : lobes) volume += lobe.domain->volumeMm3();
  std::vector<Sprout> sprouts(inlets.size());
  const Vec3 rootDirection = direction(central[0]);
  for (std::size_t region = 0; region < lobes.size(); ++region) {
    const Domain& organ = *lobes[region].domain;
    Sprout whole;
    whole.given = true;
    whole.stem = {central[0].distal, rootDirection,
                  firstNormal(organ.bounds(), rootDirection, options.rotationDeg),
                  organ.volumeMm3() / volume};
    whole.region.organ = &organ;
    whole.region.box = organ.bounds();
    whole.region.ancestors.push_back({central[0].proximal, central[0].distal, central[0].radiusMm});
    whole.region.organFlow = whole.stem.flow;
    Region probe = whole.region;
    CellGrid grid(options.grid);
    if (grid.lay(probe) == 0) {
      throw InvalidInput("the " + std::string(longName(lobes[region].lobe)) +
                         " is too thin for a grid of " + std::to_string(options.grid) +
                         " cells; choose a finer grid, or check its surface");
    }
    requireTrunkPointsIn(central, inlets, region, lobes[region], grid);
    if (servesNearest(central, inlets, region, options)) {
      giveNearest(central, inlets, region, whole, grid, sprouts);
    } else {
      LobeDivider(central, inlets, region, options, sprouts).descend(0, std::move(whole));
    }
  }
  for (std::size_t i = 0; i < sprouts.size(); ++i) sprouts[i].key = daughterKey(options.seed, i);
  return sprouts;
}

}  // namespace pneuma
