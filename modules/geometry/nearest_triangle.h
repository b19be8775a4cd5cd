#pragma once

#include <memory>

#include "core/triangle_mesh.h"

namespace pneuma {

/// Distances to a surface. Queries may run on several threads at once.
class NearestTriangle {
 public:
  /// @pre the mesh has a triangle
  explicit NearestTriangle(const TriangleMesh& mesh);
  ~NearestTriangle();
  NearestTriangle(const NearestTriangle&) = delete;
  NearestTriangle& operator=(const NearestTriangle&) = delete;

  /// Distance from `p` to the nearest point of the surface, mm.
  double distanceMm(const Vec3& p) const;

  struct Hit {
    Vec3 point = Vec3::Zero();
    std::size_t triangle = 0;  ///< that it lies upon
  };

  /// The nearest point of the surface.
  Hit nearest(const Vec3& p) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace pneuma
