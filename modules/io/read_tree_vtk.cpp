#include <array>
#include <cmath>
#include <limits>

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include "core/error.h"
#include "io/detail/branch_rows.h"
#include "io/detail/centreline_graph.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_formats.h"
#include "io/detail/vtk_xml.h"

namespace pneuma {
namespace {

constexpr std::array<const char*, 3> RadiusNames = {"radius", "Radius",
                                                    "MaximumInscribedSphereRadius"};

vtkDataArray* radiusArray(vtkPointSet& data, const std::string& name) {
  for (const char* key : RadiusNames) {
    vtkDataArray* array = data.GetPointData()->GetArray(key);
    if (array == nullptr) continue;
    if (array->GetNumberOfComponents() == 1) return array;
    throw InvalidInput(name + ": its point array \"" + key + "\" has " +
                       std::to_string(array->GetNumberOfComponents()) +
                       " components; a radius is one number per point");
  }
  throw InvalidInput(name +
                     " has no point array \"radius\" (nor \"Radius\" or "
                     "\"MaximumInscribedSphereRadius\"); add the airways' radii in mm");
}

double radiusMm(vtkDataArray& radii, vtkIdType point, const std::string& name) {
  const double radius = radii.GetComponent(point, 0);
  if (radius > 0.0 && std::isfinite(radius)) return radius;
  throw InvalidInput(name + ": point " + std::to_string(point) + " has a radius of " +
                     numberText(radius) + " mm; it must be above 0");
}

Vec3 position(vtkPointSet& data, vtkIdType point) {
  Vec3 p;
  data.GetPoint(point, p.data());
  return p;
}

/// A column of the cell data of a file that Pneuma wrote.
class CellColumn {
 public:
  CellColumn(vtkPointSet& data, const char* key, const std::string& name)
      : array_(data.GetCellData()->GetArray(key)), where_(name + ", cell array \"" + key + "\"") {
    if (array_ != nullptr && array_->GetNumberOfComponents() != 1) {
      throw InvalidInput(where_ + " has more than one component");
    }
  }

  double number(vtkIdType cell, double fallback = 0.0) const {
    return array_ == nullptr ? fallback : array_->GetComponent(cell, 0);
  }

  std::int64_t integer(vtkIdType cell) const {
    const double value = number(cell);
    if (std::abs(value) <= 1e15 && value == std::floor(value))
      return static_cast<std::int64_t>(value);
    throw InvalidInput(where_ + ": " + numberText(value) + " is not a whole number");
  }

  const std::string& where() const { return where_; }

 private:
  vtkDataArray* array_;
  std::string where_;
};

/// True if the cells are branches with their parents, as Pneuma writes them.
bool isOwn(vtkPolyData& data) {
  vtkCellData& cells = *data.GetCellData();
  return cells.GetArray("id") != nullptr && cells.GetArray("parent") != nullptr &&
         cells.GetArray("diameter_mm") != nullptr &&
         data.GetNumberOfLines() == data.GetNumberOfCells();
}

AirwayTree readOwn(vtkPolyData& data, const std::string& name, std::vector<std::string>& notes) {
  vtkDataArray& radii = *radiusArray(data, name);
  const CellColumn id(data, "id", name);
  const CellColumn parent(data, "parent", name);
  const CellColumn lobe(data, "lobe", name);
  const CellColumn segment(data, "segment", name);
  const CellColumn diameter(data, "diameter_mm", name);
  const CellColumn origin(data, "origin", name);
  const CellColumn ending(data, "ending", name);
  const CellColumn supplied(data, "supplied_ml", name);
  std::vector<BranchRow> rows(static_cast<std::size_t>(data.GetNumberOfLines()));
  for (vtkIdType cell = 0; cell < data.GetNumberOfLines(); ++cell) {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    data.GetLines()->GetCellAtId(cell, count, points);
    BranchRow& row = rows[static_cast<std::size_t>(cell)];
    row.id = id.integer(cell);
    row.parent = parent.integer(cell);
    if (count < 2) {
      throw InvalidInput(name + ": branch " + std::to_string(row.id) +
                         " has fewer than two points");
    }
    Branch& branch = row.branch;
    branch.proximal = position(data, points[0]);
    branch.distal = position(data, points[count - 1]);
    branch.radiusMm = diameter.number(cell) / 2.0;
    branch.lobe = lobeOfValue(lobe.number(cell), lobe.where());
    branch.segment = segmentOfValue(segment.number(cell), segment.where());
    branch.origin = originOfValue(origin.number(cell), origin.where());
    branch.ending = endingOfValue(ending.number(cell), ending.where());
    branch.suppliedMl = supplied.number(cell);
    branch.via.reserve(static_cast<std::size_t>(count - 2));
    for (vtkIdType i = 1; i + 1 < count; ++i) {
      branch.via.push_back({position(data, points[i]), radiusMm(radii, points[i], name)});
    }
  }
  return treeOfRows(std::move(rows), name, notes);
}

/// The graph of all line and poly-line cells. Other cells are left out, with a note.
CentrelineGraph graphOf(vtkPointSet& data, const std::string& name,
                        std::vector<std::string>& notes) {
  vtkDataArray& radii = *radiusArray(data, name);
  CentrelineGraph graph;
  vtkIdType leftOut = 0;
  const auto addCell = [&](int type, vtkIdType count, const vtkIdType* points) {
    if (type != VTK_LINE && type != VTK_POLY_LINE) {
      ++leftOut;
      return;
    }
    int last = -1;
    for (vtkIdType i = 0; i < count; ++i) {
      const int node = graph.addPoint(position(data, points[i]), radiusMm(radii, points[i], name));
      if (last >= 0) graph.addEdge(last, node);
      last = node;
    }
  };
  vtkIdType count = 0;
  const vtkIdType* points = nullptr;
  if (auto* polyData = vtkPolyData::SafeDownCast(&data)) {
    vtkCellArray* lines = polyData->GetLines();
    for (vtkIdType cell = 0; cell < lines->GetNumberOfCells(); ++cell) {
      lines->GetCellAtId(cell, count, points);
      addCell(VTK_POLY_LINE, count, points);
    }
    leftOut = polyData->GetNumberOfCells() - lines->GetNumberOfCells();
  } else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&data)) {
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
      grid->GetCells()->GetCellAtId(cell, count, points);
      addCell(grid->GetCellType(cell), count, points);
    }
  }
  if (leftOut > 0) {
    notes.push_back(name + " has " + std::to_string(leftOut) +
                    " cells that are no lines; they were left out.");
  }
  return graph;
}

void takeMetadata(vtkPointSet& data, TreeFile& file) {
  vtkFieldData& fields = *data.GetFieldData();
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    auto* texts = vtkStringArray::SafeDownCast(fields.GetAbstractArray(i));
    if (texts == nullptr || texts->GetName() == nullptr || texts->GetNumberOfValues() == 0)
      continue;
    const std::string key = texts->GetName();
    if (key != SpaceKey && key != UnitsKey) file.metadata[key] = texts->GetValue(0);
  }
}

}  // namespace

TreeFile readVtkTree(const std::string& content, const std::string& name) {
  const vtkSmartPointer<vtkPointSet> data = readVtkXml(content, name);
  if (data->GetNumberOfPoints() > std::numeric_limits<int>::max()) {
    throw InvalidInput(name + " holds more than 2147483647 points; split it");
  }
  auto* polyData = vtkPolyData::SafeDownCast(data);
  TreeFile file;
  file.format = polyData != nullptr ? "VTP" : "VTU";
  if (polyData != nullptr && polyData->GetNumberOfLines() == 0 &&
      polyData->GetNumberOfPolys() > 0) {
    throw InvalidInput(name +
                       " holds a surface, not an airway tree; give a file with center lines");
  }
  if (data->GetNumberOfCells() == 0) {
    throw InvalidInput(name + " holds no lines, so no airway; is it the right file?");
  }
  if (polyData != nullptr && isOwn(*polyData)) {
    if (const std::string piece = fieldText(*data, PieceKey.data()); !piece.empty()) {
      throw Unsupported(name + " holds a piece of a tree (" + piece +
                        "), which is for ParaView; read the whole tree, or the project");
    }
    file.tree = readOwn(*polyData, name, file.notes);
  } else {
    file.tree = graphOf(*data, name, file.notes).tree(name);
  }
  takeMetadata(*data, file);
  if (fieldText(*data, SpaceKey.data()) == "RAS") {
    file.tree = turnedFromRas(file.tree);
    file.notes.push_back(turnedFromRasNote(name));
  }
  return file;
}

}  // namespace pneuma
