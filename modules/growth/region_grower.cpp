#include "growth/region_grower.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace pneuma {

void Spread::see(double value) {
  sum += value;
  squares += value * value;
  ++count;
}

void Spread::add(const Spread& other) {
  sum += other.sum;
  squares += other.squares;
  count += other.count;
}

double Spread::mean() const { return count > 0 ? sum / static_cast<double>(count) : 0.0; }

double Spread::deviation() const {
  if (count == 0) return 0.0;
  return std::sqrt(std::max(0.0, squares / static_cast<double>(count) - mean() * mean()));
}

void RegionCounts::add(const RegionCounts& other) {
  failedLeft += other.failedLeft;
  failedRatio += other.failedRatio;
  turned += other.turned;
  corrected += other.corrected;
  correctedBelow18 += other.correctedBelow18;
  correctedDividing += other.correctedDividing;
  correctedDividingBelow18 += other.correctedDividingBelow18;
  rescuedShortened += other.rescuedShortened;
  rescuedTurned += other.rescuedTurned;
  rescuedReentered += other.rescuedReentered;
  rescuedLedRound += other.rescuedLedRound;
  rescuedDivisions += other.rescuedDivisions;
  dividedForReach += other.dividedForReach;
  halvedForShape += other.halvedForShape;
  keptInside += other.keptInside;
  lengthToDiameter.add(other.lengthToDiameter);
  rotationDeg.add(other.rotationDeg);
}

std::uint64_t daughterKey(std::uint64_t parent, std::uint64_t which) {
  // The mixing of splitmix64 (Steele, Lea and Flood 2014).
  std::uint64_t key = parent + 0x9E3779B97F4A7C15ULL * (which + 1);
  key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9ULL;
  key = (key ^ (key >> 27)) * 0x94D049BB133111EBULL;
  return key ^ (key >> 31);
}

RegionGrower::RegionGrower(const KitaokaOptions& options, double trunkDiameterMm, double totalMm3)
    : options_(options),
      trunkDiameterMm_(trunkDiameterMm),
      spacingMm_(std::cbrt(totalMm3 * options.flowThreshold / TerminalsTimesThreshold)),
      grid_(options.grid) {}

Ending RegionGrower::grow(Sprout& sprout, std::vector<RegionBranch>& branches,
                          std::vector<Sprout>& sprouts) {
  if (const Ending ending = rule9Ending(sprout); ending != Ending::None) {
    ++counts_.failedLeft;
    return ending;
  }
  if (options_.remeasure == Switch::On) sprout.stem.flow = measuredFlow(sprout.region);
  std::optional<Division> division =
      sprout.halve ? halve(grid_, sprout.stem)
                   : divide(grid_, sprout.stem, rotationDeg(sprout), options_);
  if (!division.has_value()) {
    ++counts_.failedRatio;
    return Ending::Ratio;
  }
  counts_.turned += division->turned ? 1 : 0;
  counts_.rescuedDivisions += division->rescued ? 1 : 0;
  if (!sprout.halve) counts_.rotationDeg.see(division->rotationDeg);
  const int countA = grid_.select(division->sideA, grid_.cells(), cellsA_);
  grid_.selectRest(cellsA_, cellsB_);
  rule8aLastRatio(sprout, *division);
  addDaughter(sprout, *division, {true, cellsA_, countA}, branches, sprouts);
  addDaughter(sprout, *division, {false, cellsB_, grid_.count() - countA}, branches, sprouts);
  return Ending::None;
}

/// Rule 9: has the branch left its region, or is nothing left of that? Lays the grid.
Ending RegionGrower::rule9Ending(Sprout& sprout) {
  if (!sprout.given && !sprout.region.contains(sprout.stem.tip)) return Ending::LeftRegion;
  return grid_.lay(sprout.region) < 2 ? Ending::LeftRegion : Ending::None;
}

/// Beyond the paper: the flow that belongs to the region's volume on its own grid.
double RegionGrower::measuredFlow(const Region& region) const {
  return region.organFlow * grid_.count() * grid_.cellMm3() / region.organ->volumeMm3();
}

/// The limit near the end. Both daughters are terminals then, so that region and flow need not
/// agree: the planes stay where they are.
void RegionGrower::rule8aLastRatio(const Sprout& sprout, Division& division) const {
  if (sprout.halve || sprout.stem.flow >= LastParentThresholds * options_.flowThreshold) return;
  if (division.smallerShare() >= options_.lastRatio) return;
  division.shareA = division.shareA < 0.5 ? options_.lastRatio : 1.0 - options_.lastRatio;
  division.angles = rule6BranchingAngles(division.shareA, options_.diameterExponent);
}

void RegionGrower::addDaughter(const Sprout& parent, const Division& division, const Part& part,
                               std::vector<RegionBranch>& branches, std::vector<Sprout>& sprouts) {
  const bool sideA = part.sideA;
  const Wedge wedge = sideA ? division.sideA : division.sideA.rest();
  const DaughterRoom room{parent.region, wedge,      grid_,
                          part.cells,    part.count, options_.containment};
  const Vec3 side = sideA ? division.towardsA : Vec3(-division.towardsA);
  const std::uint64_t key = daughterKey(parent.key, sideA ? 0 : 1);

  RegionBranch branch;
  branch.parent = parent.branch;
  branch.flow = parent.stem.flow * (sideA ? division.shareA : 1.0 - division.shareA);
  branch.diameterMm = rule6Diameter(branch.flow, trunkDiameterMm_, options_.diameterExponent);
  const bool large = branch.flow >= options_.flowThreshold;
  const bool halves = reachesTooFar(room);
  const bool divides = large || halves;
  counts_.dividedForReach += halves && !large ? 1 : 0;
  counts_.halvedForShape += halves && large ? 1 : 0;

  const Turn angle =
      branchingAngle(parent.stem, room, side, sideA ? division.angles.a : division.angles.b, large);
  Vec3 direction = angle.cosine * parent.stem.direction + angle.sine * side;
  const double length = branch.diameterMm * lengthToDiameter(room, parent.stem, direction,
                                                             branch.diameterMm, key, large);
  const Vec3& start = parent.stem.tip;
  const Vec3 tip = start + length * direction;
  const RescuedTip place = placed(room, parent.stem, tip, branch.diameterMm, large && !halves);
  if (place.by.has_value()) {
    branch.tip = *place.by;
    branches.push_back(branch);
    branch.parent = static_cast<int>(branches.size()) - 1;
  }
  branch.tip = place.tip;
  branch.ending = divides ? Ending::None : Ending::Flow;
  counts_.lengthToDiameter.see((branch.tip - start).norm() / branch.diameterMm);
  branches.push_back(branch);
  if (!divides) return;

  // The daughter's plane holds the parent and itself, also where it was turned out of it.
  if (branch.tip != tip) direction = (branch.tip - place.by.value_or(start)).normalized();
  Sprout sprout;
  sprout.branch = static_cast<int>(branches.size()) - 1;
  sprout.key = key;
  sprout.given = halves;
  sprout.halve = halves;
  sprout.stem = {branch.tip, direction, acrossOf(division.normal, direction), branch.flow};
  sprout.region = parent.region;
  sprout.region.walls.push_back(wedge);
  sprout.region.cuts.push_back(wedge);
  sprout.region.ancestors.push_back(
      {place.by.value_or(start), branch.tip, branch.diameterMm / 2.0});
  if (room.count > 0) sprout.region.box = grid_.boxOf(part.cells);
  sprouts.push_back(std::move(sprout));
}

/// Rule 6a for one daughter.
Turn RegionGrower::branchingAngle(const Stem& parent, const DaughterRoom& room, const Vec3& side,
                                  const Turn& angle, bool divides) {
  if (options_.rule6a == Switch::Off || room.count == 0) return angle;
  const Turn bisecting =
      bisectingAngle(grid_, room.cells, room.count, parent, room.side, side, angle);
  const Turn corrected = rule6aCorrected(angle, bisecting);
  const Turn change = corrected.minus(angle);
  if (change.sine <= 0.0) return angle;
  static const double sine18 = Turn::ofDegrees(18.0).sine;
  const bool below18 = change.sine < sine18 && change.cosine > 0.0;
  ++counts_.corrected;
  counts_.correctedBelow18 += below18 ? 1 : 0;
  counts_.correctedDividing += divides ? 1 : 0;
  counts_.correctedDividingBelow18 += divides && below18 ? 1 : 0;
  return corrected;
}

/// Rules 7 and 7a; terminals keep what rule 7 gives.
double RegionGrower::lengthToDiameter(const DaughterRoom& room, const Stem& parent,
                                      const Vec3& direction, double diameterMm, std::uint64_t key,
                                      bool divides) const {
  double ratio = options_.lengthToDiameter;
  if (options_.lengthSpread > 0.0) {
    ratio = std::max(1.0, ratio + options_.lengthSpread * Random(key).normal());
  }
  if (!divides || options_.rule7a == Switch::Off) return ratio;
  return rule7aLengthToDiameter(ratio, room.exitDistance(parent.tip, direction), diameterMm,
                                options_);
}

/// Beyond the paper: does the daughter's region reach too far from its centre? The rules only ever
/// divide along the parent, so that a long region ahead of it would become a sheaf of thin ones.
bool RegionGrower::reachesTooFar(const DaughterRoom& room) const {
  constexpr int LeastCells = 8;  // fewer could not be divided well
  if (options_.reach <= 0.0 || room.count < LeastCells) return false;
  const double ownMm = std::cbrt(room.count * grid_.cellMm3());
  const double reach = options_.reach * std::max(spacingMm_, ownMm);
  const Vec3 centre = grid_.centroidOf(room.cells);
  const Box3 box = grid_.boxOf(room.cells);  // one cell wider than the cells
  if ((box.max() - centre).cwiseMax(centre - box.min()).norm() <= reach) return false;
  return (grid_.farthestCentre(room.cells, centre) - centre).norm() > reach;
}

/// Where a daughter ends whom the rules lead to `tip`: there in the paper, else rescued, centred
/// and kept inside as the options say.
RescuedTip RegionGrower::placed(const DaughterRoom& room, const Stem& parent, const Vec3& tip,
                                double diameterMm, bool divides) {
  const Vec3& start = parent.tip;
  const bool inside = room.staysInside(start, tip);
  if (divides) {
    if (inside && (options_.rescue == Switch::Off || room.contains(tip))) return {tip};
    if (options_.rescue == Switch::On) {
      if (const auto rescued = rescuedTip(room, start, tip, diameterMm)) {
        counts_.rescuedShortened += rescued->how == Rescue::Shortened ? 1 : 0;
        counts_.rescuedTurned += rescued->how == Rescue::Turned ? 1 : 0;
        counts_.rescuedReentered += rescued->how == Rescue::Reentered ? 1 : 0;
        counts_.rescuedLedRound += rescued->how == Rescue::LedRound ? 1 : 0;
        return *rescued;
      }
    }
  } else if (options_.terminalEnds == TerminalEnds::Centre) {
    if (const auto centre = centreTip(room, start)) {
      counts_.rescuedLedRound += centre->how == Rescue::LedRound ? 1 : 0;
      return *centre;
    }
  }
  if (inside) return {tip};
  ++counts_.keptInside;
  return {insideTip(room, start, tip, parent.direction)};
}

/// Where rule 8 begins, with the random change of the paper's discussion.
double RegionGrower::rotationDeg(const Sprout& sprout) const {
  if (options_.rotationSpreadDeg <= 0.0) return options_.rotationDeg;
  return options_.rotationDeg +
         options_.rotationSpreadDeg * Random(daughterKey(sprout.key, 2)).normal();
}

}  // namespace pneuma
