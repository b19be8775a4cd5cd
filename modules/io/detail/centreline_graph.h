#pragma once

#include <string>
#include <vector>

#include "anatomy/airway_tree.h"
#include "io/detail/exact_points.h"

namespace pneuma {

/// Centrelines as other programs write them: points with radii, joined by edges in any order and
/// any direction. Points at exactly the same place are one, and so are edges that repeat.
class CentrelineGraph {
 public:
  /// Adds a point or finds the one at that place; returns its number. A point keeps the radius that
  /// it was added with first, mm.
  int addPoint(const Vec3& position, double radiusMm);

  /// @param from, to numbers of points; an edge from a point to itself is left out
  void addEdge(int from, int to);

  /// The tree of all points that have edges. It begins where all edges lead away from, if there is
  /// such an end, otherwise at the widest end, of several equally wide at the highest one (RAS and
  /// LPS agree on the z axis).
  /// @param name of the file, in quotation marks, for messages
  /// @throws InvalidInput: no edge, a cycle, several pieces
  AirwayTree tree(const std::string& name) const;

 private:
  struct Edge {
    int from = -1;
    int to = -1;
  };

  std::vector<Edge> distinctEdges() const;
  int rootOf(const std::vector<Edge>& edges, const std::string& name) const;

  ExactPoints points_;
  std::vector<double> radiiMm_;
  std::vector<Edge> edges_;
};

}  // namespace pneuma
