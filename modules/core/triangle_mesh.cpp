#include "core/triangle_mesh.h"

namespace pneuma {

Box3 bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3& p : mesh.points) box.extend(p);
  return box;
}

double areaMm2(const TriangleMesh& mesh) {
  double twice = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& p = mesh.points[a];
    twice += (mesh.points[b] - p).cross(mesh.points[c] - p).norm();
  }
  return twice / 2.0;
}

double signedVolumeMm3(const TriangleMesh& mesh) {
  if (mesh.points.empty()) return 0.0;
  const Vec3 origin = mesh.points.front();  // near the mesh, so that little cancels
  double six = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six += (mesh.points[a] - origin).dot((mesh.points[b] - origin).cross(mesh.points[c] - origin));
  }
  return six / 6.0;
}

}  // namespace pneuma
