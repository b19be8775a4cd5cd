#include "breathing/surface_points.h"

namespace pneuma {

std::vector<double> pointAreas(const TriangleMesh& surface) {
  std::vector<double> areas(surface.points.size(), 0.0);
  for (const auto& [i, j, k] : surface.triangles) {
    const Vec3& p = surface.points[i];
    const double area = 0.5 * (surface.points[j] - p).cross(surface.points[k] - p).norm();
    for (const std::uint32_t n : {i, j, k}) areas[n] += area / 3.0;
  }
  return areas;
}

std::vector<Vec3> pointNormals(const TriangleMesh& surface) {
  std::vector<Vec3> normals(surface.points.size(), Vec3::Zero());
  for (const auto& [i, j, k] : surface.triangles) {
    const Vec3& p = surface.points[i];
    const Vec3 area = (surface.points[j] - p).cross(surface.points[k] - p);
    for (const std::uint32_t n : {i, j, k}) normals[n] += area;
  }
  for (Vec3& normal : normals) {
    const double length = normal.norm();
    if (length > 0.0) normal /= length;
  }
  return normals;
}

}  // namespace pneuma
