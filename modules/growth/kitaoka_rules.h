#pragma once

#include "growth/kitaoka.h"
#include "growth/turn.h"

/// The rules of Kitaoka 1999 one by one, each named for its rule. What the paper leaves open, and
/// how it was resolved, is told in docs/algorithms/kitaoka.md.
namespace pneuma {

/// The two daughters of a branching; a belongs to the side of the plane where w points.
struct BranchingAngles {
  Turn a;
  Turn b;
};

/// Rule 5 and Eq. 6: the angles to the parent that belong to a share `a` of its flow, and to the
/// rest.
BranchingAngles rule6BranchingAngles(double shareA, double exponent);

/// Eqs. 2 and 4: diameter of a branch with this share of the whole flow.
double rule6Diameter(double flow, double trunkDiameterMm, double exponent);

/// Rule 4a's condition: do the angles differ by 10 degrees or more?
bool rule4aApplies(const BranchingAngles& angles);

/// Rule 4a's second half-plane leaves the branching point along the bisector of the daughters: at
/// this angle to the parent's direction, towards a.
Turn rule4aBend(const BranchingAngles& angles);

/// Rule 6a: an angle smaller than the one that bisects the daughter's region becomes the mean of
/// both, at most 90 degrees.
Turn rule6aCorrected(const Turn& angle, const Turn& bisecting);

/// Rules 7 and 7a: the length-to-diameter ratio that brings the way to the wall, in lengths,
/// between its limits in steps of 0.25, but not below 1.
double rule7aLengthToDiameter(double start, double distanceMm, double diameterMm,
                              const KitaokaOptions& options);

/// Rule 8: the direction in the branching plane that is normal to the parent `u`, at the rotation
/// angle from the plane with the normal `planeNormal` in which the parent was born.
Vec3 rule8InPlane(const Vec3& u, const Vec3& planeNormal, const Turn& rotation);

/// Rule 8a's steps, degrees, and how many of them lead once round.
inline constexpr double Rule8aStepDeg = 9.0;
inline constexpr int Rule8aSteps = 19;

/// The limit near the end (last paragraph of rule 8a): parents with less than this many flow
/// thresholds divide at no less than options.lastRatio.
inline constexpr double LastParentThresholds = 1.5;

/// Number of terminals times flow threshold, of a tree of which nothing fails (Table 1).
inline constexpr double TerminalsTimesThreshold = 1.67;

}  // namespace pneuma
