#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "anatomy/airway_tree.h"
#include "render/colour.h"

namespace pneuma {

/// Airways as triangles: one closed-looking tube per branch, normals radial, one colour per point.
struct TubeMesh {
  std::vector<float> points;   ///< x, y, z; LPS, mm
  std::vector<float> normals;  ///< unit vectors
  std::vector<std::uint8_t> colours;
  std::vector<std::uint32_t> branches;  ///< of each point
  std::vector<std::int32_t> triangles;  ///< counter-clockwise seen from outside
};

/// Airways as poly-lines, for frames while the user drags.
struct LineMesh {
  std::vector<float> points;
  std::vector<std::uint8_t> colours;
  std::vector<std::uint32_t> branches;  ///< of each point
  std::vector<std::int32_t> segments;   ///< two indices each
};

/// Which branches become tubes, and how thick.
struct TubeOptions {
  double radiusScale = 1.0;
  int sides = 0;  ///< of every tube, whose ends are flat then; 0: by its radius
};

/// Tubes true to radius. Measured branches follow their centreline with its radii, rings mitred at
/// its bends. At a bifurcation the mother is prolonged and the daughters begin inside her, by what
/// a mitre of their angle needs, so that no notch shows; wide ends are rounded, thin terminals
/// capped. Wide branches get more sides than thin ones.
/// @param colours one per branch; @param visible one per branch
TubeMesh tubeMesh(const AirwayTree& tree, const std::vector<bool>& visible,
                  const std::vector<Rgb>& colours, const TubeOptions& options);

/// The visible branches as lines.
LineMesh lineMesh(const AirwayTree& tree, const std::vector<bool>& visible,
                  const std::vector<Rgb>& colours);

std::array<std::uint8_t, 3> bytesOf(const Rgb& colour);

}  // namespace pneuma
