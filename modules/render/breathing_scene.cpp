#include "render/breathing_scene.h"

#include <numeric>
#include <utility>

#include <vtkDecimatePro.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include "render/convert.h"

namespace pneuma {
namespace {

constexpr const char* Origin = "origin";

/// The surface with fewer triangles between some of its points.
/// @param origins filled with the index of each point in `mesh`
TriangleMesh decimated(const TriangleMesh& mesh, double keep, std::vector<std::size_t>& origins) {
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

}  // namespace

void addCoarseSurfaces(BreathingScene& breathing,
                       const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
                       std::size_t triangles) {
  std::size_t all = 0;
  for (const auto& mesh : meshes) all += mesh->triangles.size();
  if (all <= triangles) return;
  const double keep = static_cast<double>(triangles) / static_cast<double>(all);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    BreathingScene::Surface& surface = breathing.surfaces[i];
    if (!surface.coarse) {
      std::vector<std::size_t> origins;
      surface.coarse = std::make_shared<const TriangleMesh>(decimated(*meshes[i], keep, origins));
      surface.coarseOrigins = std::make_shared<const std::vector<std::size_t>>(std::move(origins));
    }
    for (const std::size_t origin : *surface.coarseOrigins) {
      surface.coarseDisplacement.push_back(surface.displacement[origin]);
      if (!surface.values.empty()) surface.coarseValues.push_back(surface.values[origin]);
    }
  }
}

}  // namespace pneuma
