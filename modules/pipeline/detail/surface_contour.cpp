#include "pipeline/detail/surface_contour.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "geometry/planar_triangulation.h"

namespace pneuma {
namespace {

constexpr double FreeOfRim = 0.6;  ///< of the spacing: grid points nearer to the rim are left out

using Line = std::vector<Vec3>;

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return a < b ? (std::uint64_t{a} << 32U) | b : (std::uint64_t{b} << 32U) | a;
}

/// The point of the edge from `a` to `b` where a height that is linear along it is zero.
Vec3 zeroBetween(const Vec3& a, const Vec3& b, double heightA, double heightB) {
  return a + heightA / (heightA - heightB) * (b - a);
}

}  // namespace

std::vector<Line> zeroLines(const TriangleMesh& mesh, std::span<const float> heights) {
  // Every triangle that is crossed leads from one edge to another; below stays on the left.
  struct Step {
    std::uint64_t next;
    Vec3 at;
    bool taken = false;
  };

  std::unordered_map<std::uint64_t, Step> steps;
  std::vector<std::uint64_t> order;  // so that lines do not depend on a hash
  for (const auto& corners : mesh.triangles) {
    const auto below = [&](std::size_t c) { return heights[corners[c % 3]] < 0.0F; };
    for (std::size_t c = 0; c < 3; ++c) {
      if (!below(c) || below(c + 1)) continue;  // comes up over the edge c, c + 1
      const std::size_t down = below(c + 2) ? c + 1 : c + 2;
      const std::uint32_t a = corners[c];
      const std::uint32_t b = corners[(c + 1) % 3];
      const std::uint64_t from = edgeKey(a, b);
      steps[from] = {edgeKey(corners[down % 3], corners[(down + 1) % 3]),
                     zeroBetween(mesh.points[a], mesh.points[b], heights[a], heights[b])};
      order.push_back(from);
    }
  }
  std::vector<Line> lines;
  for (const std::uint64_t start : order) {
    Line line;
    for (auto at = steps.find(start); at != steps.end() && !at->second.taken;
         at = steps.find(at->second.next)) {
      at->second.taken = true;
      line.push_back(at->second.at);
    }
    if (line.size() < 3) continue;
    line.push_back(line.front());
    lines.push_back(std::move(line));
  }
  return lines;
}

TriangleMesh filled(const std::vector<Line>& lines, const HeightSurface& surface,
                    double spacingMm) {
  std::vector<Vec2> rim;
  std::vector<std::array<std::uint32_t, 2>> edges;
  TriangleMesh mesh;
  Eigen::AlignedBox2d box;
  for (const Line& line : lines) {
    const auto first = static_cast<std::uint32_t>(rim.size());
    const auto count = static_cast<std::uint32_t>(line.size() - 1);
    for (std::uint32_t i = 0; i < count; ++i) {
      mesh.points.push_back(line[i]);
      rim.push_back(surface.planar(line[i]));
      box.extend(rim.back());
      edges.push_back({first + i, first + (i + 1) % count});
    }
  }
  if (rim.empty()) return {};
  const auto planar =
      triangulateInside(rim, edges, hexagonalGrid(box, spacingMm, FreeOfRim * spacingMm));
  if (!planar) return {};
  for (std::size_t i = rim.size(); i < planar->points.size(); ++i) {
    mesh.points.push_back(surface.at(planar->points[i]));
  }
  mesh.triangles = planar->triangles;
  return mesh;
}

std::vector<Line> above(const std::vector<Line>& lines, const HeightSurface& surface) {
  std::vector<Line> parts;
  for (const Line& line : lines) {
    Line part;
    double before = 0.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const double height = surface.height(line[i]);
      if (i > 0 && (before < 0.0) != (height < 0.0)) {
        part.push_back(zeroBetween(line[i - 1], line[i], before, height));
      }
      if (height >= 0.0) {
        part.push_back(line[i]);
      } else if (!part.empty()) {
        parts.push_back(std::move(part));
        part.clear();
      }
      before = height;
    }
    if (part.size() > 1) parts.push_back(std::move(part));
  }
  return parts;
}

TriangleMesh above(const TriangleMesh& mesh, const HeightSurface& surface) {
  std::vector<double> heights;
  for (const Vec3& p : mesh.points) heights.push_back(surface.height(p));
  TriangleMesh part{mesh.points, {}};
  std::unordered_map<std::uint64_t, std::uint32_t> onEdge;
  const auto between = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, isNew] =
        onEdge.try_emplace(edgeKey(a, b), static_cast<std::uint32_t>(part.points.size()));
    if (isNew) {
      part.points.push_back(zeroBetween(mesh.points[a], mesh.points[b], heights[a], heights[b]));
    }
    return found->second;
  };
  for (const auto& corners : mesh.triangles) {
    std::vector<std::uint32_t> polygon;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = corners[c];
      const std::uint32_t b = corners[(c + 1) % 3];
      if (heights[a] >= 0.0) polygon.push_back(a);
      if ((heights[a] < 0.0) != (heights[b] < 0.0)) polygon.push_back(between(a, b));
    }
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      part.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
    }
  }
  return part;
}

}  // namespace pneuma
