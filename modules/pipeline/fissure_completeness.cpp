#include <algorithm>
#include <array>

#include "core/parallel.h"
#include "pipeline/fissure_snapping.h"
#include "segmentation/sheet_peak.h"

namespace pneuma {
namespace {

constexpr std::uint8_t Unknown = 2;

Vec3 areaVector(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3& a = mesh.points[triangle[0]];
  return 0.5 * (mesh.points[triangle[1]] - a).cross(mesh.points[triangle[2]] - a);
}

/// Gives triangles without a mark those of their neighbours, from the inside to the rim.
void spread(const TriangleMesh& mesh, std::vector<std::uint8_t>& marks) {
  std::vector<std::uint8_t> ofPoint(mesh.points.size(), Unknown);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t t = 0; t < marks.size(); ++t) {
      if (marks[t] == Unknown) continue;
      for (const std::uint32_t point : mesh.triangles[t]) {
        if (ofPoint[point] == Unknown) ofPoint[point] = marks[t];
      }
    }
    std::vector<std::uint8_t> next = marks;
    for (std::size_t t = 0; t < marks.size(); ++t) {
      if (marks[t] != Unknown) continue;
      for (const std::uint32_t point : mesh.triangles[t]) {
        if (ofPoint[point] == Unknown) continue;
        next[t] = ofPoint[point];
        changed = true;
        break;
      }
    }
    marks = std::move(next);
  }
  std::ranges::replace(marks, Unknown, std::uint8_t{0});
}

}  // namespace

Completeness completeness(const SheetnessImage& sheets, const TriangleMesh& patch,
                          const SnapOptions& options, const Progress& progress) {
  requireValid(options);
  const SheetSampler sampler(sheets);
  const SheetSearch search{options.coherenceMm, options.angleDeg, options.coherenceMm,
                           options.strength};
  // Normals of the surface, not of single triangles, which lean where they are slim.
  std::vector<Vec3> normals(patch.points.size(), Vec3::Zero());
  for (const auto& triangle : patch.triangles) {
    for (const std::uint32_t point : triangle) normals[point] += areaVector(patch, triangle);
  }
  Completeness result;
  result.onSheet.assign(patch.triangles.size(), Unknown);
  parallelFor(patch.triangles.size(), [&](std::size_t t) {
    progress.throwIfStopped();
    const auto& [a, b, c] = patch.triangles[t];
    const Vec3 middle = (patch.points[a] + patch.points[b] + patch.points[c]) / 3.0;
    const Vec3 normal = normals[a] + normals[b] + normals[c];
    if (!sampler.isMeasured(middle) || !(normal.norm() > 0.0)) return;
    result.onSheet[t] = coherentSheet(sampler, middle, normal.normalized(), search) ? 1 : 0;
  });
  double measured = 0.0;
  double on = 0.0;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    if (result.onSheet[t] == Unknown) continue;
    const double area = areaVector(patch, patch.triangles[t]).norm();
    measured += area;
    if (result.onSheet[t] == 1) on += area;
  }
  result.share = measured > 0.0 ? on / measured : 0.0;
  spread(patch, result.onSheet);
  progress.report(1.0);
  return result;
}

}  // namespace pneuma
