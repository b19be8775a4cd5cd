#include "io/detail/vtk_xml.h"

#include <cmath>
#include <new>

#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "core/error.h"
#include "io/detail/text_fields.h"
#include "io/detail/vtk_errors.h"

namespace pneuma {
namespace {

void requireIndices(vtkCellArray* cells, vtkIdType pointCount, const std::string& name) {
  if (cells == nullptr) return;
  vtkIdType last = 0;
  const vtkIdType connectivitySize = cells->GetNumberOfConnectivityIds();
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell) {
    // Offsets before anything that follows them.
    vtkIdType begin = 0;
    vtkIdType end = 0;
    if (cells->IsStorage64Bit()) {
      begin = cells->GetOffsetsArray64()->GetValue(cell);
      end = cells->GetOffsetsArray64()->GetValue(cell + 1);
    } else {
      begin = cells->GetOffsetsArray32()->GetValue(cell);
      end = cells->GetOffsetsArray32()->GetValue(cell + 1);
    }
    if (begin != last || end < begin || end > connectivitySize) {
      throw InvalidInput(name + " is damaged: cell " + std::to_string(cell) + " has points from " +
                         std::to_string(begin) + " to " + std::to_string(end) + " of " +
                         std::to_string(connectivitySize));
    }
    last = end;
  }
  const auto requireId = [&](vtkIdType id) {
    if (id >= 0 && id < pointCount) return;
    throw InvalidInput(name + " is damaged: a cell names point " + std::to_string(id) + " of " +
                       std::to_string(pointCount));
  };
  for (vtkIdType i = 0; i < connectivitySize; ++i) {
    requireId(cells->IsStorage64Bit() ? cells->GetConnectivityArray64()->GetValue(i)
                                      : cells->GetConnectivityArray32()->GetValue(i));
  }
}

void requireFinite(vtkPoints* points, const std::string& name) {
  if (points == nullptr) return;
  double p[3];
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    points->GetPoint(i, p);
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
    throw InvalidInput(name + ": point " + std::to_string(i) +
                       " has a coordinate that is not a number; mend or export the file anew");
  }
}

template <class Reader, class DataSet>
vtkSmartPointer<vtkPointSet> readAs(const std::string& content, const std::string& name) {
  vtkNew<Reader> reader;
  const VtkErrors errors(*reader);
  reader->ReadFromInputStringOn();
  reader->SetInputString(content);
  try {
    reader->Update();
  } catch (const std::bad_alloc&) {
    // What it states was held against the size of the file before.
    throw Error(ExitCode::OutOfMemory, name + " does not fit into the memory there is");
  }
  if (!errors.first().empty()) {
    throw InvalidInput(name + " is damaged; VTK says: " + errors.first());
  }
  const vtkSmartPointer<DataSet> data = reader->GetOutput();
  requireSoundGeometry(*data, name);
  return data;
}

}  // namespace

bool looksLikeVtkXml(const std::string& content) {
  const std::string_view head = std::string_view(content).substr(0, 4096);
  const std::size_t root = head.find("<VTKFile");
  return root != std::string_view::npos && trimmed(head).starts_with('<');
}

void requireSoundGeometry(vtkPointSet& data, const std::string& name) {
  requireFinite(data.GetPoints(), name);
  const vtkIdType pointCount = data.GetNumberOfPoints();
  if (auto* polyData = vtkPolyData::SafeDownCast(&data)) {
    for (vtkCellArray* cells : {polyData->GetVerts(), polyData->GetLines(), polyData->GetPolys(),
                                polyData->GetStrips()}) {
      requireIndices(cells, pointCount, name);
    }
  } else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&data)) {
    requireIndices(grid->GetCells(), pointCount, name);
  }
}

vtkSmartPointer<vtkPointSet> readVtkXml(const std::string& content, const std::string& name) {
  if (requireSoundVtkXml(content, name) == "PolyData") {
    return readAs<vtkXMLPolyDataReader, vtkPolyData>(content, name);
  }
  return readAs<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(content, name);
}

std::string vtpText(vtkPolyData& data) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  const VtkErrors errors(*writer);
  writer->SetInputData(&data);
  writer->WriteToOutputStringOn();
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  if (writer->Write() == 0 || !errors.first().empty()) {
    throw std::bad_alloc();  // into a string nothing else can fail
  }
  return writer->GetOutputString();
}

std::string fieldText(vtkPointSet& data, const char* key) {
  const auto* array = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray(key));
  return array != nullptr && array->GetNumberOfValues() > 0
             ? const_cast<vtkStringArray*>(array)->GetValue(0)
             : "";
}

void setFieldText(vtkPolyData& data, const std::string& key, const std::string& value) {
  vtkNew<vtkStringArray> array;
  array->SetName(key.c_str());
  array->InsertNextValue(value);
  data.GetFieldData()->AddArray(array);
}

}  // namespace pneuma
