#include "render/convert.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

namespace pneuma {
namespace {

template <class Array, class Value>
vtkSmartPointer<Array> arrayOf(const std::vector<Value>& values, int components) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<float>& coordinates) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(arrayOf<vtkFloatArray>(coordinates, 3));
  return points;
}

vtkSmartPointer<vtkCellArray> cellsOf(const std::vector<std::int32_t>& indices, int perCell) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const std::size_t count = indices.size() / static_cast<std::size_t>(perCell);
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(count) + 1);
  for (std::size_t i = 0; i <= count; ++i) {
    offsets->SetValue(static_cast<vtkIdType>(i), static_cast<std::int32_t>(i) * perCell);
  }
  cells->SetData(offsets, arrayOf<vtkTypeInt32Array>(indices, 1));
  return cells;
}

std::vector<Vec3> smoothNormals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals = areaVectors(mesh);
  for (Vec3& normal : normals) normal = normal.norm() > 0.0 ? Vec3(normal.normalized()) : normal;
  return normals;
}

std::vector<float> flattened(const std::vector<Vec3>& vectors) {
  std::vector<float> result;
  result.reserve(vectors.size() * 3);
  for (const Vec3& v : vectors) {
    for (int axis = 0; axis < 3; ++axis) result.push_back(static_cast<float>(v[axis]));
  }
  return result;
}

/// The triangles without those that are there before, with the same corners in the same order. Told
/// apart only where there are far more than the two for each point that a surface has: damaged
/// files hold thousands of copies of a triangle, and every veil of it is drawn.
std::vector<std::array<std::uint32_t, 3>> drawnTriangles(const TriangleMesh& mesh) {
  constexpr std::size_t MostPerPoint = 6;
  if (mesh.triangles.size() / MostPerPoint <= mesh.points.size()) return mesh.triangles;
  std::vector<std::array<std::uint32_t, 3>> drawn = mesh.triangles;
  for (auto& triangle : drawn) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
  }
  std::sort(drawn.begin(), drawn.end());
  drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
  return drawn;
}

}  // namespace

std::vector<Vec3> areaVectors(const TriangleMesh& mesh) {
  std::vector<Vec3> vectors(mesh.points.size(), Vec3::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 twiceArea = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    for (const std::uint32_t corner : {a, b, c}) vectors[corner] += twiceArea;
  }
  return vectors;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const TriangleMesh& mesh) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  std::vector<std::int32_t> indices;
  const auto triangles = drawnTriangles(mesh);
  indices.reserve(triangles.size() * 3);
  for (const auto& triangle : triangles) {
    for (const std::uint32_t corner : triangle) {
      indices.push_back(static_cast<std::int32_t>(corner));
    }
  }
  data->SetPoints(pointsOf(flattened(mesh.points)));
  data->SetPolys(cellsOf(indices, 3));
  data->GetPointData()->SetNormals(arrayOf<vtkFloatArray>(flattened(smoothNormals(mesh)), 3));
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const TubeMesh& mesh) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(mesh.points));
  data->SetPolys(cellsOf(mesh.triangles, 3));
  data->GetPointData()->SetNormals(arrayOf<vtkFloatArray>(mesh.normals, 3));
  data->GetPointData()->SetScalars(arrayOf<vtkUnsignedCharArray>(mesh.colours, 3));
  return data;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const LineMesh& mesh) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(mesh.points));
  data->SetLines(cellsOf(mesh.segments, 2));
  data->GetPointData()->SetScalars(arrayOf<vtkUnsignedCharArray>(mesh.colours, 3));
  return data;
}

}  // namespace pneuma
