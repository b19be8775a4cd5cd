#include "core/triangle_mesh.h"

#include <limits>

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

TriangleMesh partOf(const TriangleMesh& mesh,
                    std::span<const std::array<std::uint32_t, 3>> triangles,
                    std::vector<std::uint32_t>* taken) {
  constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> places(mesh.points.size(), None);
  TriangleMesh part;
  part.triangles.assign(triangles.begin(), triangles.end());
  for (auto& triangle : part.triangles) {
    for (std::uint32_t& corner : triangle) {
      if (places[corner] == None) {
        places[corner] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(mesh.points[corner]);
        if (taken != nullptr) taken->push_back(corner);
      }
      corner = places[corner];
    }
  }
  return part;
}

}  // namespace pneuma
