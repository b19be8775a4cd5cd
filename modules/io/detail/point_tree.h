#pragma once

#include <string>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// A tree of points, each joined to its parent: how SWC and centreline files hold airways.
struct PointTree {
  struct Node {
    Vec3 position;  ///< LPS, mm
    double radiusMm = 0.0;
    int parent = -1;  ///< index of another node, before or after this one; -1 for the root
    Lobe lobe = Lobe::Whole;
    Origin origin = Origin::Measured;
    bool endsBranch = false;  ///< a branch ends here even if it goes on with a single child
  };

  std::vector<Node> nodes;

  /// True if the radius at a branch's distal end is the radius of the branch. Otherwise it is the
  /// mean along the branch's centreline.
  bool endRadiusIsBranchRadius = false;
};

/// The branches from bifurcation to bifurcation, with the points between in `via`, untouched.
/// Where the nodes' parents come first the branches keep the order of their distal ends.
/// @param name of the file, in quotation marks, for messages
/// @throws InvalidInput: fewer than two points, no or two roots, a cycle, a bifurcation at the root
AirwayTree treeOfPoints(const PointTree& points, const std::string& name);

}  // namespace pneuma
