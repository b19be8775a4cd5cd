#pragma once

#include <span>
#include <vector>

#include "breathing/vertex_neighbours.h"

namespace pneuma {

/// Where the points of a lung's surface go: their normals, drawn towards those of neighbours that
/// move like them (Santhanam 2003, section 4.3). One pass, in which every point reads the normals
/// that were given: the paper's loop repeated is a smoother without an end.
/// @param normals of length 1
/// @return unit vectors
std::vector<Vec3> strainDirections(const VertexNeighbours& neighbours, std::span<const double> shot,
                                   std::span<const Vec3> normals);

/// A lung's surface that is scaled by steps of volume along fixed directions (section 5.3):
/// inhaling adds a factor times Shot_i n_i to every position, exhaling takes it away. The paper
/// calls the factor for a volume j a surface area, which has no dimension that fits; here it is j /
/// sum of Shot_i n_i . a_i with a_i the area vectors, so that a small step changes the volume by j.
class VolumeSteps {
 public:
  /// @throws InvalidInput if the counts differ, or the directions do not enlarge the surface
  VolumeSteps(const TriangleMesh& surface, std::span<const double> shot,
              std::span<const Vec3> directions);

  const TriangleMesh& surface() const { return surface_; }

  /// Shot_i n_i.
  const std::vector<Vec3>& displacement() const { return displacement_; }

  /// The factor, mm. @param volumeMm3 below 0: exhale
  double scaleFor(double volumeMm3) const { return volumeMm3 / gain_; }

  /// One step. @param volumeMm3 below 0: exhale
  void step(double volumeMm3);

 private:
  TriangleMesh surface_;
  std::vector<Vec3> displacement_;
  double gain_ = 0.0;  ///< mm^2
};

}  // namespace pneuma
