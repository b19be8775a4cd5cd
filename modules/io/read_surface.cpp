#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/exact_points.h"
#include "io/detail/surface_formats.h"
#include "io/detail/text_fields.h"
#include "io/detail/vtk_errors.h"
#include "io/detail/vtk_xml.h"
#include "io/surface_file.h"

namespace pneuma {
namespace {

constexpr std::array<std::string_view, 4> Extensions = {".stl", ".obj", ".ply", ".vtp"};

constexpr std::string_view Formats = "STL, OBJ, PLY or VTP";

/// "STL", "OBJ", "PLY", "VTP" by the content, "" if it is none of them.
std::string formatOfContent(const std::string& content) {
  if (content.starts_with("ply\n") || content.starts_with("ply\r\n")) return "PLY";
  if (looksLikeVtkXml(content)) return "VTP";
  if (looksLikeStl(content)) return "STL";
  return looksLikeObj(content) ? "OBJ" : "";
}

std::string formatOfExtension(const std::filesystem::path& path) {
  std::string extension = lowerCase(path.extension().string());
  if (!isSurfaceFileName(path)) return "";
  extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  return extension;
}

template <class Reader>
vtkSmartPointer<vtkPolyData> outputOf(Reader& reader, const SurfaceHead& head,
                                      const std::string& name) {
  const VtkErrors errors(static_cast<vtkAlgorithm&>(reader));
  reader.Update();
  if (!errors.first().empty()) {
    throw InvalidInput(name + " is damaged; VTK says: " + errors.first());
  }
  const vtkSmartPointer<vtkPolyData> data = reader.GetOutput();
  const vtkIdType faces = data->GetNumberOfPolys();
  if (faces != static_cast<vtkIdType>(head.faces)) {
    throw InvalidInput(name + " is damaged: of its " + std::to_string(head.faces) +
                       " faces, only " + std::to_string(faces) + " could be read; export it anew");
  }
  requireSoundGeometry(*data, name);
  return data;
}

vtkSmartPointer<vtkPolyData> readStl(const std::filesystem::path& path, const SurfaceHead& head,
                                     const std::string& name) {
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(path.c_str());
  // VTK's merging is slower than reading itself; equal points are joined with a hash below.
  reader->MergingOff();
  return outputOf(*reader, head, name);
}

vtkSmartPointer<vtkPolyData> readObj(const std::filesystem::path& path, const SurfaceHead& head,
                                     const std::string& name) {
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(path.c_str());
  return outputOf(*reader, head, name);
}

vtkSmartPointer<vtkPolyData> readPly(const std::string& content, const SurfaceHead& head,
                                     const std::string& name) {
  // VTK's lists of faces come from one heap for the whole process, which goes with each file.
  static std::mutex oneAtATime;
  const std::lock_guard lock(oneAtATime);
  vtkNew<vtkPLYReader> reader;
  reader->ReadFromInputStringOn();
  // VTK frees memory twice where the last line of a text has no end.
  reader->SetInputString(content.ends_with('\n') ? content : content + '\n');
  return outputOf(*reader, head, name);
}

vtkSmartPointer<vtkPolyData> readVtp(const std::string& content, const std::string& name) {
  const vtkSmartPointer<vtkPointSet> data = readVtkXml(content, name);
  vtkSmartPointer<vtkPolyData> polyData = vtkPolyData::SafeDownCast(data);
  if (polyData == nullptr) {
    throw Unsupported(name + " is a VTU file, which holds no surface here; save it as VTP");
  }
  if (polyData->GetNumberOfPolys() + polyData->GetNumberOfStrips() == 0 &&
      polyData->GetNumberOfLines() > 0) {
    throw InvalidInput(name + " holds lines (an airway tree?), not a surface");
  }
  return polyData;
}

/// All polygons and strips as triangles.
vtkSmartPointer<vtkPolyData> triangulated(vtkPolyData& data, SurfaceFile& file,
                                          const std::string& name) {
  vtkCellArray* polygons = data.GetPolys();
  const vtkIdType strips = data.GetNumberOfStrips();
  if (strips == 0 && (polygons->GetNumberOfCells() == 0 || polygons->IsHomogeneous() == 3)) {
    return &data;
  }
  vtkNew<vtkTriangleFilter> filter;
  const VtkErrors errors(static_cast<vtkAlgorithm&>(*filter));
  filter->SetInputData(&data);
  filter->PassVertsOff();
  filter->PassLinesOff();
  filter->Update();
  const vtkSmartPointer<vtkPolyData> triangles = filter->GetOutput();
  file.notes.push_back(name + " has faces that are no triangles; its " +
                       std::to_string(polygons->GetNumberOfCells() + strips) +
                       " faces were cut into " + std::to_string(triangles->GetNumberOfPolys()) +
                       " triangles.");
  if (!errors.first().empty()) {
    file.notes.push_back(name +
                         " has faces that could not be cut into triangles: " + errors.first());
  }
  return triangles;
}

InvalidInput noTriangle(const std::string& name) {
  return InvalidInput(name + " holds no triangle; is it the right file?");
}

TriangleMesh meshOf(vtkPolyData& data, bool ras, const std::string& name) {
  const vtkIdType count = data.GetNumberOfPolys();
  if (count == 0) throw noTriangle(name);
  if (3 * count > std::numeric_limits<std::int32_t>::max()) {
    throw InvalidInput(name + " holds more than 715827882 triangles; simplify it first");
  }
  TriangleMesh mesh;
  mesh.triangles.resize(static_cast<std::size_t>(count));
  ExactPoints points;
  vtkIdType corners = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType i = 0; i < count; ++i) {
    data.GetPolys()->GetCellAtId(i, corners, ids);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec3 p;
      data.GetPoint(ids[corner], p.data());
      if (ras) p = Vec3(-p.x(), -p.y(), p.z());
      mesh.triangles[static_cast<std::size_t>(i)][corner] = points.add(p);
    }
  }
  mesh.points = std::move(points).take();
  return mesh;
}

/// The array "lobe" of the triangles, as Pneuma writes it: whole numbers below 256, one for each.
std::vector<std::uint8_t> lobesOf(vtkPolyData& data) {
  vtkDataArray* array = data.GetCellData()->GetArray("lobe");
  const vtkIdType count = data.GetNumberOfPolys();
  if (array == nullptr || array->GetNumberOfComponents() != 1 ||
      array->GetNumberOfTuples() != count || data.GetNumberOfCells() != count) {
    return {};
  }
  std::vector<std::uint8_t> lobes;
  lobes.reserve(static_cast<std::size_t>(count));
  for (vtkIdType n = 0; n < count; ++n) {
    const double value = array->GetComponent(n, 0);
    if (!(value >= 0.0 && value < 256.0 && value == std::floor(value))) return {};
    lobes.push_back(static_cast<std::uint8_t>(value));
  }
  return lobes;
}

}  // namespace

bool isSurfaceFileName(const std::filesystem::path& path) {
  const std::string extension = lowerCase(path.extension().string());
  return std::find(Extensions.begin(), Extensions.end(), extension) != Extensions.end();
}

SurfaceFile readSurface(const std::filesystem::path& path) {
  const std::string content = readFile(path);
  const std::string name = quoted(path);
  if (content.empty()) {
    throw InvalidInput(name + " is empty; give a surface as " + std::string(Formats));
  }
  SurfaceFile file;
  file.format = formatOfContent(content);
  const std::string extensionFormat = formatOfExtension(path);
  if (file.format.empty() && extensionFormat.empty()) {
    throw Unsupported(name + " is not a surface that can be read; give " + std::string(Formats));
  }
  if (file.format.empty()) {
    if (extensionFormat == "STL") checkStl(content, name);
    throw InvalidInput(name + " is damaged or no " + extensionFormat +
                       " file, although its name says so; get it anew");
  }
  if (file.format != extensionFormat) {
    file.notes.push_back(name + " was read as " + file.format +
                         ", which it holds whatever its name.");
  }
  vtkSmartPointer<vtkPolyData> data;
  if (file.format == "VTP") {
    data = readVtp(content, name);
    file.space = fieldText(*data, "SPACE");
  } else {
    const SurfaceHead head = file.format == "STL"   ? checkStl(content, name)
                             : file.format == "OBJ" ? checkObj(content, name)
                                                    : checkPly(content, name);
    if (head.faces == 0) throw noTriangle(name);
    file.space = head.space;
    data = file.format == "STL"   ? readStl(path, head, name)
           : file.format == "OBJ" ? readObj(path, head, name)
                                  : readPly(content, head, name);
  }
  if (file.space != "LPS" && file.space != "RAS") file.space.clear();
  data = triangulated(*data, file, name);
  file.lobes = lobesOf(*data);
  file.mesh = meshOf(*data, file.space == "RAS", name);
  if (file.space == "RAS") {
    file.notes.push_back(name + " is in RAS coordinates; they were turned to LPS.");
  }
  return file;
}

std::string spaceIn(std::string_view text) {
  for (const std::string_view space : {"LPS", "RAS"}) {
    if (text.find("SPACE=" + std::string(space)) != std::string_view::npos) {
      return std::string(space);
    }
  }
  return "";
}

}  // namespace pneuma
