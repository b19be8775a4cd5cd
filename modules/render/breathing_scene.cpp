#include "render/breathing_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include <vtkDecimatePro.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include "core/parallel.h"
#include "core/point_hash.h"
#include "render/convert.h"

namespace pneuma {
namespace {

constexpr const char* Origin = "origin";
constexpr std::size_t ShellTriangles = 8000;
constexpr std::size_t ManyTriangles = 100'000;
constexpr double LeastKept = 0.3;  // of triangles, by taking points out one after the other

/// Without those that lie upon each other: the two sides of a sheet that has no room between them.
void dropFolded(std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::map<std::array<std::uint32_t, 3>, std::size_t> times;
  const auto sorted = [](std::array<std::uint32_t, 3> triangle) {
    std::ranges::sort(triangle);
    return triangle;
  };
  for (const auto& triangle : triangles) ++times[sorted(triangle)];
  std::erase_if(triangles, [&](const auto& triangle) { return times.at(sorted(triangle)) > 1; });
}

/// The surface with one of its points for each cell of a grid: quick, and even rather than good.
/// @param origins filled with the index of each point in `mesh`
TriangleMesh thinnedOut(const TriangleMesh& mesh, double cellMm,
                        std::vector<std::size_t>& origins) {
  std::unordered_map<Vec3, std::uint32_t, PointHash> cells;
  std::vector<std::uint32_t> cellOf;
  std::vector<Vec3> sums;
  std::vector<double> counts;
  for (const Vec3& p : mesh.points) {
    const Vec3 cell = (p / cellMm).array().floor();
    const auto next = static_cast<std::uint32_t>(sums.size());
    const auto [found, first] = cells.try_emplace(cell, next);
    if (first) {
      sums.push_back(Vec3::Zero());
      counts.push_back(0.0);
    }
    cellOf.push_back(found->second);
    sums[cellOf.back()] += p;
    counts[cellOf.back()] += 1.0;
  }
  origins.assign(sums.size(), 0);
  std::vector<double> least(sums.size(), std::numeric_limits<double>::max());
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const std::uint32_t cell = cellOf[n];
    const double away = (mesh.points[n] - sums[cell] / counts[cell]).squaredNorm();
    if (away >= least[cell]) continue;
    least[cell] = away;
    origins[cell] = n;
  }
  TriangleMesh thin;
  for (const std::size_t origin : origins) thin.points.push_back(mesh.points[origin]);
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<std::uint32_t, 3> triangle = {cellOf[a], cellOf[b], cellOf[c]};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
      continue;
    }
    thin.triangles.push_back(triangle);
  }
  dropFolded(thin.triangles);
  return thin;
}

/// The surface with points taken out one after the other, where that changes it least.
TriangleMesh reduced(const TriangleMesh& mesh, double keep, std::vector<std::size_t>& origins) {
  const vtkSmartPointer<vtkPolyData> data = polyDataOf(mesh);
  vtkNew<vtkIdTypeArray> indices;
  indices->SetName(Origin);
  indices->SetNumberOfValues(data->GetNumberOfPoints());
  std::iota(indices->GetPointer(0), indices->GetPointer(0) + data->GetNumberOfPoints(),
            vtkIdType{0});
  data->GetPointData()->AddArray(indices);
  vtkNew<vtkDecimatePro> decimate;
  decimate->SetInputData(data);
  decimate->SetTargetReduction(1.0 - keep);
  decimate->PreserveTopologyOff();
  decimate->Update();
  vtkPolyData* few = decimate->GetOutput();
  auto* kept = vtkIdTypeArray::SafeDownCast(few->GetPointData()->GetArray(Origin));
  TriangleMesh coarse;
  origins.clear();
  for (vtkIdType n = 0; n < few->GetNumberOfPoints(); ++n) {
    origins.push_back(static_cast<std::size_t>(kept->GetValue(n)));
    coarse.points.push_back(mesh.points[origins.back()]);
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < few->GetNumberOfCells(); ++cell) {
    few->GetCellPoints(cell, corners);
    std::array<std::uint32_t, 3> triangle{};
    for (vtkIdType n = 0; n < 3; ++n) {
      triangle[static_cast<std::size_t>(n)] = static_cast<std::uint32_t>(corners->GetId(n));
    }
    coarse.triangles.push_back(triangle);
  }
  return coarse;
}

/// The surface with fewer triangles between some of its points.
/// @param origins filled with the index of each point in `mesh`
TriangleMesh decimated(const TriangleMesh& mesh, std::size_t triangles,
                       std::vector<std::size_t>& origins) {
  const auto wanted = static_cast<double>(triangles);
  const double keep = wanted / static_cast<double>(mesh.triangles.size());
  if (keep >= LeastKept || mesh.triangles.size() < ManyTriangles)
    return reduced(mesh, keep, origins);
  // To take so many points out one after the other would take seconds.
  const double cellMm = std::sqrt(3.0 * LeastKept * areaMm2(mesh) / wanted);
  std::vector<std::size_t> before;
  const TriangleMesh thin = thinnedOut(mesh, cellMm, before);
  const double rest = wanted / static_cast<double>(thin.triangles.size());
  TriangleMesh coarse = reduced(thin, std::min(1.0, rest), origins);
  for (std::size_t& origin : origins) origin = before[origin];
  return coarse;
}

/// Which points of each mesh lie exactly where another mesh has one.
std::vector<std::vector<bool>> sharedPoints(
    const std::vector<std::shared_ptr<const TriangleMesh>>& meshes) {
  constexpr std::size_t Several = std::numeric_limits<std::size_t>::max();
  std::unordered_map<Vec3, std::size_t, PointHash> owner;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (const Vec3& p : meshes[i]->points) {
      const auto [at, first] = owner.try_emplace(p, i);
      if (!first && at->second != i) at->second = Several;
    }
  }
  std::vector<std::vector<bool>> shared(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (const Vec3& p : meshes[i]->points) shared[i].push_back(owner.at(p) == Several);
  }
  return shared;
}

}  // namespace

void addCoarseSurfaces(BreathingScene& breathing,
                       const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
                       std::size_t triangles) {
  std::size_t all = 0;
  for (const auto& mesh : meshes) all += mesh->triangles.size();
  if (all <= triangles) return;
  const double keep = static_cast<double>(triangles) / static_cast<double>(all);
  parallelFor(meshes.size(), [&](std::size_t i) {
    BreathingScene::Surface& surface = breathing.surfaces[i];
    if (!surface.coarse) {
      std::vector<std::size_t> origins;
      const auto kept = static_cast<std::size_t>(
          std::lround(keep * static_cast<double>(meshes[i]->triangles.size())));
      surface.coarse = std::make_shared<const TriangleMesh>(decimated(*meshes[i], kept, origins));
      surface.coarseOrigins = std::make_shared<const std::vector<std::size_t>>(std::move(origins));
    }
    for (const std::size_t origin : *surface.coarseOrigins) {
      surface.coarseDisplacement.push_back(surface.displacement[origin]);
      if (!surface.values.empty()) surface.coarseValues.push_back(surface.values[origin]);
    }
  });
}

BreathingScene::Shell shellOf(BreathingScene::Shell::Of of, Side side, const TriangleMesh& surface,
                              std::span<const Vec3> displacement) {
  BreathingScene::Shell shell{of, side, nullptr, {displacement.begin(), displacement.end()}};
  if (surface.triangles.size() <= ShellTriangles) {
    shell.mesh = std::make_shared<const TriangleMesh>(surface);
    return shell;
  }
  std::vector<std::size_t> origins;
  shell.mesh = std::make_shared<const TriangleMesh>(decimated(surface, ShellTriangles, origins));
  shell.displacement.clear();
  for (const std::size_t origin : origins) shell.displacement.push_back(displacement[origin]);
  return shell;
}

void addOnionSkin(BreathingScene& breathing,
                  const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
                  const BreathScale& expiration, const BreathScale& inspiration) {
  const std::vector<std::vector<bool>> shared = sharedPoints(meshes);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const BreathingScene::Surface& surface = breathing.surfaces[i];
    if (surface.side == Side::None) continue;
    auto outside = std::make_shared<TriangleMesh>();
    const bool coarse = surface.coarse != nullptr;
    outside->points = (coarse ? *surface.coarse : *meshes[i]).points;
    for (const auto& triangle : (coarse ? *surface.coarse : *meshes[i]).triangles) {
      const bool between = std::ranges::all_of(triangle, [&](std::uint32_t n) {
        return shared[i][coarse ? (*surface.coarseOrigins)[n] : n];
      });
      if (!between) outside->triangles.push_back(triangle);
    }
    BreathingScene::Shell shell{
        BreathingScene::Shell::Of::Expiration, surface.side, std::move(outside),
        coarse ? surface.coarseDisplacement : surface.displacement, expiration.of(surface.side)};
    breathing.shells.push_back(shell);
    shell.of = BreathingScene::Shell::Of::Inspiration;
    shell.scale = inspiration.of(surface.side);
    breathing.shells.push_back(std::move(shell));
  }
}

}  // namespace pneuma
