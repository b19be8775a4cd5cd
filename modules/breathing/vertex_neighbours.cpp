#include "breathing/vertex_neighbours.h"

#include <algorithm>
#include <utility>

namespace pneuma {

VertexNeighbours::VertexNeighbours(const TriangleMesh& surface) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(6 * surface.triangles.size());
  for (const auto& triangle : surface.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = triangle[corner];
      const std::uint32_t b = triangle[(corner + 1) % 3];
      if (a == b) continue;
      pairs.emplace_back(a, b);
      pairs.emplace_back(b, a);
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  first_.assign(surface.points.size() + 1, 0);
  all_.reserve(pairs.size());
  for (const auto& [from, to] : pairs) {
    ++first_[from + 1];
    all_.push_back(to);
  }
  for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
}

std::vector<Vec3> vertexAreaVectors(const TriangleMesh& surface) {
  std::vector<Vec3> areas(surface.points.size(), Vec3::Zero());
  for (const auto& [i, j, k] : surface.triangles) {
    const Vec3 area =
        (surface.points[j] - surface.points[i]).cross(surface.points[k] - surface.points[i]) / 6.0;
    for (const std::uint32_t n : {i, j, k}) areas[n] += area;
  }
  return areas;
}

}  // namespace pneuma
