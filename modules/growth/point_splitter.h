#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/domain.h"
#include "core/progress.h"
#include "growth/centroid_splitting.h"

namespace pneuma {

/// A branch as the splitter makes it: straight, its parent stored before it.
struct SplitBranch {
  int parent = -1;  ///< index among the branches of the same splitter call; -1: the inlet
  Vec3 end;
  std::uint32_t points = 0;  ///< points served at this end: all of a terminal's, those of daughters
                             ///< that were not made
};

/// What happened on the way, for the report.
struct SplitCounts {
  std::uint64_t dropped = 0;  ///< daughters not made because they would be too short or had no way
  std::uint64_t droppedPoints = 0;  ///< points of those daughters, served by their mothers
  std::uint64_t shortened = 0;      ///< branches shortened to stay inside
  std::uint64_t redirected = 0;     ///< branches led to a lattice point, angle limits waived
};

/// What grew from one inlet.
struct SplitTree {
  std::vector<SplitBranch> branches;
  std::uint32_t inletPoints = 0;  ///< points served by the inlet itself
  SplitCounts counts;
};

/// The rules of the paper with lengths already scaled to the spacing.
struct SplitRules {
  double ratio = 0.41;
  int minPoints = 5;
  double minLengthMm = 1.2;
  double minAngleRad = 0.0;
  double maxAngleRad = 0.0;
  Containment containment = Containment::Branches;
  double spacingMm = 0.0;      ///< of the lattice the points come from
  Vec3 anchor = Vec3::Zero();  ///< a node of it
};

/// Where growth starts.
struct SplitInlet {
  Vec3 end;
  Vec3 direction;        ///< unit vector of the inlet branch
  Vec3 parentDirection;  ///< unit vector of its parent; zero for a root
};

/// Grows from one inlet by splitting `points` again and again (Huang 2004, 2.4). One thread,
/// O(n log n). The points are kept as 16-bit multiples of a fraction of the spacing, so that sums
/// are exact and the result does not depend on their order.
/// @throws InvalidInput if the points spread over more than 65,000 such multiples; Cancelled
SplitTree splitPoints(const SplitInlet& inlet, std::span<const Vec3> points, const Domain& domain,
                      const SplitRules& rules, const Progress& progress = {});

}  // namespace pneuma
