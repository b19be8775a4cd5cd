#pragma once

#include <memory>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// Distances to a surface, to its nearest point and along lines. Queries may run on several threads
/// at once.
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

  struct LineHit {
    double alongMm = 0.0;      ///< from the line's point, in its direction
    std::size_t triangle = 0;  ///< that is passed there
  };

  /// Where the line through `p` passes the surface, `fromMm` to `toMm` along it, nearest to `p`
  /// first. Triangles that the line lies in are left out.
  /// @param direction of length 1
  std::vector<LineHit> along(const Vec3& p, const Vec3& direction, double fromMm,
                             double toMm) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace pneuma
