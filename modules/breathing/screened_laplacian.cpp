#include "breathing/screened_laplacian.h"

#include <algorithm>

namespace pneuma {
namespace {

constexpr double MostCotangent = 100.0;  // of slivers

}  // namespace

PointMatrix screenedLaplacian(const TriangleMesh& surface, std::span<const double> areas,
                              std::span<const double> stiffness, double lengthMm) {
  PointMatrix matrix = edgeMatrix(surface);
  const auto stiffnessOf = [&](std::uint32_t n) { return stiffness.empty() ? 1.0 : stiffness[n]; };
  for (const auto& triangle : surface.triangles) {
    const auto& [i, j, k] = triangle;
    if (i == j || j == k || k == i) continue;
    const double mean = (stiffnessOf(i) + stiffnessOf(j) + stiffnessOf(k)) / 3.0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = triangle[(corner + 1) % 3];
      const std::uint32_t b = triangle[(corner + 2) % 3];
      const Vec3 toA = surface.points[a] - surface.points[triangle[corner]];
      const Vec3 toB = surface.points[b] - surface.points[triangle[corner]];
      const double sine = toA.cross(toB).norm();
      if (!(sine > 0.0)) continue;
      const double cotangent = std::clamp(toA.dot(toB) / sine, -MostCotangent, MostCotangent);
      const double weight = 0.5 * lengthMm * lengthMm * mean * cotangent;
      matrix.value[matrix.entry(a, b)] -= weight;
      matrix.value[matrix.entry(b, a)] -= weight;
    }
  }
  for (std::uint32_t row = 0; row < matrix.size(); ++row) {
    double sum = areas[row] * stiffnessOf(row);
    for (std::size_t at = matrix.first[row]; at < matrix.first[row + 1]; ++at) {
      matrix.value[at] = std::min(0.0, matrix.value[at]);
      sum -= matrix.value[at];
    }
    matrix.diagonal[row] = sum > 0.0 ? sum : 1.0;  // a point without a triangle stays by itself
  }
  return matrix;
}

}  // namespace pneuma
