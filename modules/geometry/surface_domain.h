#pragma once

#include <memory>

#include "core/domain.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// The inside of a closed surface. A grid, filled once by scan conversion, answers far from the
/// wall; near it the answer is the surface's own, from the triangles of the cell alone, so that a
/// query's cost does not grow with the number of triangles elsewhere.
///
/// Points nearer to the wall than rounding can tell (about 1e-13 mm) count as outside.
class SurfaceDomain : public Domain {
 public:
  /// @pre `mesh` is closed and oriented (geometry/mesh_doctor.h)
  /// @param cellMm side of the grid's cells; 0: chosen from the size of the region
  /// @throws InvalidInput if the surface is not closed or not oriented, or encloses nothing
  explicit SurfaceDomain(TriangleMesh mesh, double cellMm = 0.0);
  ~SurfaceDomain() override;

  bool contains(const Vec3& p) const override;
  bool containsSegment(const Vec3& a, const Vec3& b) const override;
  /// By the grid, without a search tree.
  bool containsBox(const Box3& box) const override;
  std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const override;
  /// Marched by the grid, near the wall in steps of 0.5 mm.
  double exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const override;
  /// Exact. The first call builds a search tree.
  double distanceToWall(const Vec3& p) const override;
  Box3 bounds() const override;
  double volumeMm3() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pneuma
