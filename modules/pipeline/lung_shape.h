#pragma once

#include <memory>
#include <vector>

#include "anatomy/lobe.h"
#include "pipeline/fissure_surfaces.h"

namespace pneuma {

/// A whole lung, measured once so that its lobes can be followed while fissures move.
struct LungShape {
  Side side = Side::None;
  std::shared_ptr<const TriangleMesh> mesh;
  LungExtent extent;
  double volumeMm3 = 0.0;
  std::vector<Vec3> inside;  ///< points of a grid, each for the same share of the volume
};

/// @param lung closed, oriented outwards, LPS, mm
/// @throws as lungBox()
LungShape lungShape(std::shared_ptr<const TriangleMesh> lung, Side side);

}  // namespace pneuma
