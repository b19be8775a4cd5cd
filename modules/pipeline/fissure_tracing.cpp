#include "pipeline/fissure_tracing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pipeline/lobe_preview.h"

namespace pneuma {
namespace {

constexpr double PatchSpacingMm = 4.0;
constexpr double CellMm = 1.5;

std::vector<Vec3> pointsOf(const GivenFissures& given, Fissure fissure) {
  const auto found = given.find(fissure);
  return found == given.end() ? std::vector<Vec3>() : found->second.points;
}

/// Twice the area of a triangle, negative when it runs clockwise.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

bool encloses(const std::array<Vec2, 3>& triangle, const Vec2& p) {
  const double first = turn(triangle[0], triangle[1], p);
  const double second = turn(triangle[1], triangle[2], p);
  const double third = turn(triangle[2], triangle[0], p);
  return (first >= 0.0 && second >= 0.0 && third >= 0.0) ||
         (first <= 0.0 && second <= 0.0 && third <= 0.0);
}

}  // namespace

TracedFissures tracedFissures(const std::shared_ptr<const LungShape>& lung,
                              const LobeInputs& inputs, const LobeOptions& options,
                              const SheetnessImage* sheets, const Progress& progress) {
  std::vector<std::string> ignored;  // the split tells them, and the list of points
  UsedFissures used = fissureSurfaces(lung->extent, lung->side, inputs.given, options, ignored);
  FissureSnappings snapped;
  if (inputs.snap && sheets != nullptr) {
    snapped = snapFissures(used, *sheets, inputs.given, options, *inputs.snap, ignored,
                           progress.part(0.0, 0.8, "snapping fissures"));
  }
  FissureSurfaces surfaces;
  for (const auto& [fissure, one] : used) surfaces[fissure] = one.surface;
  const LobePreview preview(lung, surfaces);
  TracedFissures traced;
  for (auto& [fissure, one] : used) {
    TracedFissure& to = traced[fissure];
    to.used = std::move(one);
    const auto moved = snapped.find(fissure);
    to.points =
        moved == snapped.end() ? pointsOf(inputs.given, fissure) : moved->second.points.points;
    TriangleMesh patch = preview.patch(fissure, PatchSpacingMm);
    if (sheets != nullptr && !patch.triangles.empty()) {
      to.complete = completeness(*sheets, patch, inputs.snap.value_or(SnapOptions{}),
                                 progress.part(0.8, 1.0, "looking at fissures"));
    }
    to.patch = std::make_shared<const TriangleMesh>(std::move(patch));
  }
  progress.report(1.0);
  return traced;
}

TracedFissures tracedFissures(const LobesOfLungs& lobes, const GivenFissures& given) {
  TracedFissures traced;
  for (const SplitLung& lung : lobes.lungs) {
    for (const Fissure fissure : fissuresOf(lung.side)) {
      TracedFissure& to = traced[fissure];
      to.used = lobes.fissures.at(fissure);
      const auto moved = lobes.snapped.find(fissure);
      to.points =
          moved == lobes.snapped.end() ? pointsOf(given, fissure) : moved->second.points.points;
      to.patch = std::make_shared<const TriangleMesh>(fissurePatch(lung, fissure));
      const auto complete = lobes.complete.find(fissure);
      if (complete != lobes.complete.end()) to.complete = complete->second;
    }
  }
  return traced;
}

ShownParts::ShownParts(const HeightSurface& surface, const TriangleMesh& patch,
                       const std::vector<std::uint8_t>& onSheet) {
  frame_.centre = surface.centre;
  frame_.axes = surface.axes;
  if (patch.triangles.empty()) return;
  Vec2 last = frame_.planar(patch.points.front());
  first_ = last;
  for (const Vec3& p : patch.points) {
    first_ = first_.cwiseMin(frame_.planar(p));
    last = last.cwiseMax(frame_.planar(p));
  }
  columns_ = static_cast<int>(std::floor((last.x() - first_.x()) / CellMm)) + 1;
  rows_ = static_cast<int>(std::floor((last.y() - first_.y()) / CellMm)) + 1;
  missing_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    if (onSheet[t] != 0) continue;
    std::array<Vec2, 3> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      corners[i] = (frame_.planar(patch.points[patch.triangles[t][i]]) - first_) / CellMm;
    }
    const Vec2 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Vec2 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    for (int row = static_cast<int>(low.y()); row <= static_cast<int>(high.y()); ++row) {
      for (int column = static_cast<int>(low.x()); column <= static_cast<int>(high.x()); ++column) {
        const bool in = encloses(corners, Vec2(column + 0.5, row + 0.5));
        if (in && row < rows_ && column < columns_) missing_[cellOf(column, row)] = 1;
      }
    }
  }
}

bool ShownParts::shows(const Vec3& p) const {
  const Vec2 cell = (frame_.planar(p) - first_) / CellMm;
  const int column = static_cast<int>(std::floor(cell.x()));
  const int row = static_cast<int>(std::floor(cell.y()));
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return true;
  return missing_[cellOf(column, row)] == 0;
}

}  // namespace pneuma
