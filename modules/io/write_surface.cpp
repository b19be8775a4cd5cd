#include <algorithm>
#include <bit>
#include <cstdint>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/surface_formats.h"
#include "io/detail/text_fields.h"
#include "io/detail/vtk_xml.h"
#include "io/surface_file.h"

namespace pneuma {
namespace {

static_assert(std::endian::native == std::endian::little,
              "binary STL and PLY are written little-endian");

void requireWritableMesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    throw InvalidInput("the surface cannot be written: it has no triangle");
  }
  for (const Vec3& p : mesh.points) {
    if (!p.allFinite()) {
      throw InvalidInput("the surface cannot be written: it has a coordinate that is not a number");
    }
  }
}

template <class Value>
void appendBytes(std::string& text, const Value* values, std::size_t count) {
  text.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

void appendFloats(std::string& text, const Vec3& p) {
  const Eigen::Vector3f single = p.cast<float>();
  appendBytes(text, single.data(), 3);
}

std::string stlText(const TriangleMesh& mesh, const SurfaceTags& tags) {
  // Not "solid": that would begin an ASCII file.
  std::string text = "Pneuma surface, " + tags.units + ", SPACE=" + tags.space;
  text.resize(StlHeadBytes, ' ');
  text.reserve(StlHeadBytes + 4 + StlTriangleBytes * mesh.triangles.size());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  appendBytes(text, &count, 1);
  for (const auto& triangle : mesh.triangles) {
    const Vec3& a = mesh.points[triangle[0]];
    const Vec3& b = mesh.points[triangle[1]];
    const Vec3& c = mesh.points[triangle[2]];
    appendFloats(text, (b - a).cross(c - a).stableNormalized());
    for (const Vec3* corner : {&a, &b, &c}) appendFloats(text, *corner);
    text.append(2, '\0');
  }
  return text;
}

std::string objText(const TriangleMesh& mesh, const SurfaceTags& tags) {
  std::string text(ObjTitle);
  text += std::to_string(mesh.points.size()) + " points, " + std::to_string(mesh.triangles.size()) +
          " triangles\n# SPACE=" + tags.space + ", " + tags.units + "\n";
  for (const Vec3& p : mesh.points) {
    text += 'v';
    for (const double coordinate : {p.x(), p.y(), p.z()}) {
      text += ' ';
      appendNumber(text, coordinate);
    }
    text += '\n';
  }
  for (const auto& triangle : mesh.triangles) {
    text += 'f';
    for (const std::uint32_t point : triangle) {
      text += ' ';
      appendNumber(text, std::int64_t{point} + 1);
    }
    text += '\n';
  }
  return text;
}

vtkNew<vtkPolyData> polyDataOf(const TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  }
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateEstimate(static_cast<vtkIdType>(mesh.triangles.size()), 3);
  for (const auto& triangle : mesh.triangles) {
    triangles->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

std::string plyText(const TriangleMesh& mesh, const SurfaceTags& tags) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment SPACE=" + tags.space + ", " +
                     tags.units + "\nelement vertex " + std::to_string(mesh.points.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(mesh.triangles.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  text.reserve(text.size() + 24 * mesh.points.size() + 13 * mesh.triangles.size());
  for (const Vec3& p : mesh.points) appendBytes(text, p.data(), 3);
  for (const auto& triangle : mesh.triangles) {
    text += '\3';
    appendBytes(text, triangle.data(), 3);
  }
  return text;
}

void addMarks(vtkPolyData& data, const TriangleMarks& marks) {
  for (const auto& [name, values] : marks) {
    const vtkNew<vtkUnsignedCharArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    data.GetCellData()->AddArray(array);
  }
}

vtkNew<vtkDoubleArray> doubles(const std::string& name, int components, const double* values,
                               std::size_t count) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  std::copy(values, values + count * static_cast<std::size_t>(components), array->GetPointer(0));
  return array;
}

std::string vtpSurfaceText(const TriangleMesh& mesh, const SurfaceTags& tags,
                           const TriangleMarks& marks) {
  const vtkNew<vtkPolyData> data = polyDataOf(mesh);
  addMarks(*data, marks);
  setFieldText(*data, "SPACE", tags.space);
  setFieldText(*data, "units", tags.units);
  return vtpText(*data);
}

}  // namespace

void writeSurface(const std::filesystem::path& path, const TriangleMesh& mesh,
                  const SurfaceTags& tags, const TriangleMarks& marks) {
  using Writer = std::string (*)(const TriangleMesh&, const SurfaceTags&);
  const std::string extension = lowerCase(path.extension().string());
  const Writer writer = extension == ".stl"   ? static_cast<Writer>(stlText)
                        : extension == ".ply" ? plyText
                        : extension == ".obj" ? objText
                                              : nullptr;
  if (writer == nullptr && extension != ".vtp") {
    throw Unsupported("cannot write " + quoted(path) +
                      " as a surface; end its name in .stl, .ply, .obj or .vtp");
  }
  requireWritableMesh(mesh);
  writeFile(path, writer == nullptr ? vtpSurfaceText(mesh, tags, marks) : writer(mesh, tags));
}

void writeVtpSurface(const std::filesystem::path& path, const TriangleMesh& mesh,
                     const SurfaceArrays& arrays) {
  requireWritableMesh(mesh);
  const vtkNew<vtkPolyData> data = polyDataOf(mesh);
  for (const auto& [name, values] : arrays.pointVectors) {
    data->GetPointData()->AddArray(doubles(name, 3, values.front().data(), values.size()));
  }
  for (const auto& [name, values] : arrays.pointValues) {
    data->GetPointData()->AddArray(doubles(name, 1, values.data(), values.size()));
  }
  for (const auto& [name, value] : arrays.fieldValues) {
    data->GetFieldData()->AddArray(doubles(name, 1, &value, 1));
  }
  addMarks(*data, arrays.triangleMarks);
  setFieldText(*data, "SPACE", "LPS");
  setFieldText(*data, "units", "mm");
  writeFile(path, vtpText(*data));
}

}  // namespace pneuma
