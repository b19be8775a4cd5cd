#include "io/point_file.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "io/detail/tree_formats.h"
#include "io/detail/vtk_xml.h"

namespace pneuma {

std::string pointsText(std::span<const Vec3> points, const std::vector<PointArray>& arrays,
                       const std::map<std::string, std::string>& metadata) {
  const auto count = static_cast<vtkIdType>(points.size());
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  positions->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(count, count);
  for (vtkIdType i = 0; i < count; ++i) {
    positions->SetPoint(i, points[static_cast<std::size_t>(i)].data());
    vertices->InsertNextCell(1, &i);
  }
  data->SetPoints(positions);
  data->SetVerts(vertices);
  for (const PointArray& array : arrays) {
    vtkNew<vtkIntArray> values;
    values->SetName(array.name.c_str());
    values->SetNumberOfValues(count);
    for (vtkIdType i = 0; i < count; ++i) {
      values->SetValue(i, array.values[static_cast<std::size_t>(i)]);
    }
    data->GetPointData()->AddArray(values);
  }
  for (const auto& [key, value] : metadata) setFieldText(*data, key, value);
  setFieldText(*data, std::string(SpaceKey), "LPS");
  setFieldText(*data, std::string(UnitsKey), std::string(Units));
  return vtpText(*data);
}

}  // namespace pneuma
