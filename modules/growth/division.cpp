#include "growth/division.h"

#include <algorithm>

namespace pneuma {
namespace {

/// The plane of rule 4: a's side of the plane through the parent's axis.
Wedge rule4Side(const Stem& stem, const Vec3& towardsA) {
  return {WedgeKind::Plane, stem.tip, towardsA, Vec3::Zero()};
}

/// Takes `side` as the side of a: the share of cells (rule 5) and the angles (rule 6) follow.
void takeSide(Division& division, const Wedge& side, int cellsA, int cells, double exponent) {
  division.sideA = side;
  division.shareA = static_cast<double>(cellsA) / cells;
  division.angles = rule6BranchingAngles(division.shareA, exponent);
}

/// Beyond the paper: bends the front half-plane away from the smaller daughter until it has
/// `share` of the cells, or as much as bending by 120 degrees gives.
void bendFor(Division& division, double share, const CellGrid& grid, const Stem& stem,
             const KitaokaOptions& options) {
  const bool aSmaller = division.shareA <= 0.5;
  const Vec3 towardsSmaller = aSmaller ? division.towardsA : Vec3(-division.towardsA);
  const auto wanted = static_cast<int>(share * grid.count());
  Turn enough = Turn::ofDegrees(-120.0);
  Turn tooLittle{1.0, 0.0};
  for (int step = 0; step < 8; ++step) {
    const Turn middle = enough.bisector(tooLittle);
    const bool reached = grid.countIn(rule4aSide(stem, towardsSmaller, middle)) >= wanted;
    (reached ? enough : tooLittle) = middle;
  }
  const Wedge side = rule4aSide(stem, towardsSmaller, enough);
  const int cells = grid.countIn(side);
  division.towardsA = towardsSmaller;
  takeSide(division, side, cells, grid.count(), options.diameterExponent);
}

/// Rules 8, 4, 5, 6 and 4a at one rotation angle.
Division divideAt(const CellGrid& grid, const Stem& stem, double rotationDeg,
                  const KitaokaOptions& options) {
  Division division;
  division.rotationDeg = rotationDeg;
  division.towardsA = rule8InPlane(stem.direction, stem.planeNormal, Turn::ofDegrees(rotationDeg));
  // The same sense of rotation for all that follows, whichever daughter becomes a.
  division.normal = stem.direction.cross(division.towardsA);
  const int cells = grid.count();
  int cellsA = grid.countIn(rule4Side(stem, division.towardsA));
  if (2 * cellsA > cells) {  // a is the smaller one
    division.towardsA = -division.towardsA;
    cellsA = cells - cellsA;
  }
  takeSide(division, rule4Side(stem, division.towardsA), cellsA, cells, options.diameterExponent);
  if (options.rule4a == Switch::On && rule4aApplies(division.angles)) {
    const Wedge side = rule4aSide(stem, division.towardsA, rule4aBend(division.angles));
    takeSide(division, side, grid.countIn(side), cells, options.diameterExponent);
  }
  if (division.smallerShare() < options.symmetry) {
    bendFor(division, options.symmetry, grid, stem, options);
  }
  return division;
}

/// Does the smaller daughter get its least share, and anything at all?
bool enough(const Division& division, const KitaokaOptions& options) {
  return division.smallerShare() >= options.ratioThreshold && division.smallerShare() > 0.0;
}

/// Rule 8a: turns the branching plane by 9 degrees to the better side, and on until the smaller
/// daughter has its least share.
std::optional<Division> rule8aTurned(const CellGrid& grid, const Stem& stem, double rotationDeg,
                                     const KitaokaOptions& options) {
  const auto at = [&](double degrees) { return divideAt(grid, stem, degrees, options); };
  Division plus = at(rotationDeg + Rule8aStepDeg);
  Division minus = at(rotationDeg - Rule8aStepDeg);
  const bool forwards = plus.smallerShare() >= minus.smallerShare();
  Division division = forwards ? plus : minus;
  const double step = forwards ? Rule8aStepDeg : -Rule8aStepDeg;
  for (int i = 2; i <= Rule8aSteps && !enough(division, options); ++i) {
    division = at(rotationDeg + i * step);
  }
  division.turned = true;
  if (!enough(division, options)) return std::nullopt;
  return division;
}

/// Beyond the paper: where no rotation is enough, the plane is bent instead.
Division rescued(const CellGrid& grid, const Stem& stem, double rotationDeg,
                 const KitaokaOptions& options) {
  Division division = divideAt(grid, stem, rotationDeg, options);
  bendFor(division, std::clamp(2.0 * options.ratioThreshold, 0.1, 0.5), grid, stem, options);
  division.rescued = true;
  return division;
}

}  // namespace

Vec3 acrossOf(const Vec3& normal, const Vec3& direction) {
  const Vec3 across = normal - normal.dot(direction) * direction;
  return across.norm() > 1e-6 ? Vec3(across.normalized()) : anyPerpendicular(direction);
}

Wedge rule4aSide(const Stem& stem, const Vec3& towardsA, const Turn& bend) {
  const Vec3 front = bend.cosine * towardsA - bend.sine * stem.direction;
  return {bend.sine >= 0.0 ? WedgeKind::Both : WedgeKind::Either, stem.tip, towardsA, front};
}

std::optional<Division> divide(const CellGrid& grid, const Stem& stem, double rotationDeg,
                               const KitaokaOptions& options) {
  const Division first = divideAt(grid, stem, rotationDeg, options);
  if (enough(first, options)) return first;
  std::optional<Division> division;
  if (options.rule8a == Switch::On) division = rule8aTurned(grid, stem, rotationDeg, options);
  if (!division.has_value() && options.rescue == Switch::On) {
    const Division bent = rescued(grid, stem, rotationDeg, options);
    if (enough(bent, options)) return bent;
  }
  return division;
}

std::optional<Division> halve(const CellGrid& grid, const Stem& stem) {
  const Vec3 middle = grid.centroidOf(grid.cells());
  const Vec3 way = grid.farthestCentre(grid.cells(), middle) - middle;
  if (way.norm() <= 0.0) return std::nullopt;
  Division division;
  division.sideA = {WedgeKind::Plane, middle, way.normalized(), Vec3::Zero()};
  const int cellsA = grid.countIn(division.sideA);
  if (cellsA == 0 || cellsA == grid.count()) return std::nullopt;
  division.shareA = static_cast<double>(cellsA) / grid.count();
  division.towardsA = acrossOf(way, stem.direction);
  division.normal = stem.direction.cross(division.towardsA);
  division.angles = {Turn::ofDegrees(45.0), Turn::ofDegrees(45.0)};
  return division;
}

Turn bisectingAngle(const CellGrid& grid, const RowMasks& cells, int count, const Stem& stem,
                    const Wedge& side, const Vec3& towards, const Turn& angle) {
  // Cells at less than `turn` from the parent's direction; what of a bent region lies on the other
  // side of that is in front of the branching point, at negative angles.
  const bool beyond = side.kind == WedgeKind::Either;
  const auto below = [&](const Turn& turn) {
    const Vec3 normal = turn.sine * stem.direction - turn.cosine * towards;
    const WedgeKind kind = beyond ? WedgeKind::Either : WedgeKind::Plane;
    return grid.countIn({kind, stem.tip, normal, -towards}, cells);
  };
  int cellsBelowLow = below(angle);
  if (2 * cellsBelowLow >= count) return angle;
  // Rule 6a takes the mean with `angle` and stops at 90 degrees: beyond 180 degrees less `angle`
  // all bisecting angles give the same.
  Turn low = angle;
  Turn high = angle.cosine > 0.0 ? Turn{-angle.cosine, angle.sine} : Turn{-1.0, 0.0};
  int cellsBelowHigh = below(high);
  if (2 * cellsBelowHigh < count) return high;
  constexpr int Steps = 6;
  for (int step = 0; step < Steps && 2 * cellsBelowLow + 1 < count; ++step) {
    // Between the bounds as the counts lie, and every other time half-way.
    const double part = step % 2 == 1 ? 0.5
                                      : (0.5 * count - cellsBelowLow) /
                                            static_cast<double>(cellsBelowHigh - cellsBelowLow);
    const Turn middle = low.towards(high, std::clamp(part, 0.1, 0.9));
    const int cellsBelow = below(middle);
    if (2 * cellsBelow < count) {
      low = middle;
      cellsBelowLow = cellsBelow;
    } else {
      high = middle;
      cellsBelowHigh = cellsBelow;
    }
  }
  return low.bisector(high);
}

}  // namespace pneuma
