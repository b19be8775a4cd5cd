#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "anatomy/airway_tree.h"
#include "anatomy/tree_motion.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// What the graphics card needs of each point to move it: u and which lung it is in, and what its
/// normal changes by. The points stay as they are in memory; one value for each lung moves all.
struct BreathAttributes {
  std::vector<float> normals;       ///< n, unit vectors; of airways empty, whose tubes have them
  std::vector<float> displacement;  ///< u in mm, and 0 for the right lung, 1 for the left
  std::vector<float>
      normalSlope;  ///< N(s) is along n + s times this; 3 zeros where it is not known
};

/// Of a surface: normals are those of the moved surface, exact to first order in s.
BreathAttributes breathAttributes(const TriangleMesh& mesh, std::span<const Vec3> displacement,
                                  Side side);

/// Of points on tubes or lines around airways; normals turn with none.
/// @param points x, y, z of each
/// @param branches which branch each is of
BreathAttributes breathAttributes(const AirwayTree& tree, const TreeMotion& motion,
                                  std::span<const float> points,
                                  std::span<const std::uint32_t> branches);

}  // namespace pneuma
