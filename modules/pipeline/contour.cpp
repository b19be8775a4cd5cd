#include "pipeline/contour.h"

#include <utility>

#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace pneuma {

TriangleMesh contourOf(vtkImageData& image, double value) {
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(&image);
  contour->SetValue(0, value);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkPolyData& surface = *contour->GetOutput();
  TriangleMesh mesh;
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
    mesh.points.emplace_back(surface.GetPoint(i));
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < surface.GetNumberOfCells(); ++i) {
    surface.GetCellPoints(i, corners);
    mesh.triangles.push_back({static_cast<std::uint32_t>(corners->GetId(0)),
                              static_cast<std::uint32_t>(corners->GetId(1)),
                              static_cast<std::uint32_t>(corners->GetId(2))});
  }
  if (signedVolumeMm3(mesh) < 0.0) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

}  // namespace pneuma
