#include "breathing/breathing_surfaces.h"

#include <random>

#include "geometry/test_surfaces.h"

namespace pneuma::testing {

TriangleMesh lungShaped(int subdivisions) {
  TriangleMesh mesh = sphere(1.0, Vec3::Zero(), subdivisions);
  for (Vec3& p : mesh.points) {
    p = Vec3(-70.0, 10.0, 30.0) + p.cwiseProduct(Vec3(60.0, 95.0, 130.0)) * (1.0 - 0.15 * p.z());
  }
  return mesh;
}

TriangleMesh irregular(const TriangleMesh& mesh) {
  TriangleMesh result;
  result.points = mesh.points;
  std::mt19937 random(3);
  for (const auto& [i, j, k] : mesh.triangles) {
    if (random() % 3 != 0) {
      result.triangles.push_back({i, j, k});
      continue;
    }
    const auto middle = static_cast<std::uint32_t>(result.points.size());
    result.points.emplace_back((mesh.points[i] + mesh.points[j] + mesh.points[k]) / 3.0);
    result.triangles.push_back({i, j, middle});
    result.triangles.push_back({j, k, middle});
    result.triangles.push_back({k, i, middle});
  }
  return result;
}

TriangleMesh sheet(int side, double stepMm) {
  TriangleMesh mesh;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) mesh.points.emplace_back(stepMm * x, stepMm * y, 0.0);
  }
  for (int y = 0; y + 1 < side; ++y) {
    for (int x = 0; x + 1 < side; ++x) {
      const auto at = static_cast<std::uint32_t>(side * y + x);
      const auto above = static_cast<std::uint32_t>(at + side);
      mesh.triangles.push_back({at, at + 1, above + 1});
      mesh.triangles.push_back({at, above + 1, above});
    }
  }
  return mesh;
}

Vec3 anyDirection(std::mt19937& random) {
  std::normal_distribution<double> any;
  return Vec3(any(random), any(random), any(random)).normalized();
}

}  // namespace pneuma::testing
