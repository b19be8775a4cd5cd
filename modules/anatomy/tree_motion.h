#pragma once

#include <array>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// How airways move with their lungs: each point from x to x + s u.
struct TreeMotion {
  std::vector<std::array<Vec3, 2>> ends;  ///< u of both ends of each branch, mm
  std::vector<std::vector<Vec3>> via;     ///< u of the points between, as many as the branch has
};

/// A branch at s. @param n its index in the tree that the motion is of
inline Branch movedBranch(Branch branch, const TreeMotion& motion, std::size_t n, double s) {
  branch.proximal += s * motion.ends[n][0];
  branch.distal += s * motion.ends[n][1];
  for (std::size_t v = 0; v < branch.via.size(); ++v) {
    branch.via[v].position += s * motion.via[n][v];
  }
  return branch;
}

}  // namespace pneuma
