#pragma once

#include <memory>
#include <vector>

#include "document/snapshot.h"
#include "support/sample_trees.h"

/// Snapshots whose figures can be worked out by hand.
namespace pneuma::testing {

inline LobeSurface surfaceOf(Lobe lobe, double volumeMl) {
  LobeSurface surface;
  surface.lobe = lobe;
  surface.name = std::string(shortName(lobe)) + ".stl";
  surface.mesh = std::make_shared<const TriangleMesh>();
  surface.health.volumeMl = volumeMl;
  surface.health.components = 1;
  surface.health.closed = surface.health.manifold = surface.health.orientedOutwards = true;
  return surface;
}

/// Left lower lobe of 100 ml before right upper lobe of 300 ml, in that order, and no tree.
inline LungModel twoLobes() {
  LungModel model;
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(
      std::vector{surfaceOf(Lobe::LeftLower, 100.0), surfaceOf(Lobe::RightUpper, 300.0)});
  return model;
}

/// A trachea of 100 mm straight down, 16 mm wide, and two daughters of 50 mm at right angles to it.
inline AirwayTree threeBranches() {
  AirwayTree tree;
  addBranch(tree, -1, {0.0, 0.0, -100.0}, 8.0, Lobe::Central);
  addBranch(tree, 0, {-50.0, 0.0, 0.0}, 5.0, Lobe::RightUpper);
  addBranch(tree, 0, {50.0, 0.0, 0.0}, 6.0, Lobe::LeftLower);
  return tree;
}

inline Snapshot lobesAndTree() {
  LungModel model = twoLobes();
  model.opened = std::make_shared<const AirwayTree>(threeBranches());
  return snapshotOf(std::move(model), QStringLiteral("test"));
}

}  // namespace pneuma::testing
