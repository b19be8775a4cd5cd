#pragma once

#include <cstddef>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// How far a daughter turns from her mother.
struct BranchingAngle {
  std::size_t daughter = 0;
  double radians = 0.0;
  bool major = false;  ///< the widest daughter; of equally wide ones that with the most flow
};

/// The branching angle of every daughter whose mother has two or more: between the straight lines
/// from end to end of the two branches. Branches without length have no direction and are left out.
std::vector<BranchingAngle> branchingAngles(const AirwayTree& tree);

/// How far a branching plane is turned against the one before it.
struct RotationAngle {
  std::size_t mother = 0;  ///< the branch that ends where the second plane lies
  double radians = 0.0;    ///< in [0, pi/2]: planes have no direction
};

/// Rotation between successive branching planes (Kitaoka 1999). A plane is spanned by the two
/// daughters of a mother; one-daughter steps between two forks are passed over. Forks with more
/// than two daughters, or with daughters in one line, have no plane.
std::vector<RotationAngle> rotationAngles(const AirwayTree& tree);

}  // namespace pneuma
