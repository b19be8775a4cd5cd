#include <span>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include "io/detail/branch_columns.h"
#include "io/detail/tree_formats.h"
#include "io/detail/vtk_xml.h"

namespace pneuma {
namespace {

/// Every branch has its own points, so that a daughter's tube begins with the daughter's radius.
void addGeometry(vtkPolyData& data, std::span<const Branch> branches) {
  std::size_t pointCount = 2 * branches.size();
  for (const Branch& branch : branches) pointCount += branch.via.size();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->Allocate(static_cast<vtkIdType>(pointCount));
  vtkNew<vtkDoubleArray> radius;
  radius->SetName("radius");
  radius->Allocate(static_cast<vtkIdType>(pointCount));
  vtkNew<vtkCellArray> lines;
  lines->AllocateExact(static_cast<vtkIdType>(branches.size()), static_cast<vtkIdType>(pointCount));
  const auto addPoint = [&](const Vec3& p, double radiusMm) {
    radius->InsertNextValue(radiusMm);
    lines->InsertCellPoint(points->InsertNextPoint(p.data()));
  };
  for (const Branch& branch : branches) {
    lines->InsertNextCell(static_cast<int>(branch.via.size() + 2));
    addPoint(branch.proximal, branch.radiusMm);
    for (const CentrelinePoint& point : branch.via) addPoint(point.position, point.radiusMm);
    addPoint(branch.distal, branch.radiusMm);
  }
  data.SetPoints(points);
  data.SetLines(lines);
  data.GetPointData()->AddArray(radius);
}

/// Adds a cell array with `value(i)` for every branch i from `first` on.
template <class Array, class Value>
void addColumn(vtkPolyData& data, std::size_t first, const char* name, Value&& value) {
  vtkNew<Array> array;
  array->SetName(name);
  const vtkIdType count = data.GetNumberOfCells();
  array->SetNumberOfValues(count);
  for (vtkIdType i = 0; i < count; ++i) {
    array->SetValue(
        i, static_cast<typename Array::ValueType>(value(first + static_cast<std::size_t>(i))));
  }
  data.GetCellData()->AddArray(array);
}

}  // namespace

std::string vtpText(const AirwayTree& tree, const Metadata& metadata, std::size_t first,
                    std::size_t end) {
  const BranchColumns columns(tree);
  vtkNew<vtkPolyData> data;
  addGeometry(*data, std::span(tree.begin(), tree.end()).subspan(first, end - first));
  using Byte = vtkUnsignedCharArray;
  using Whole = vtkIntArray;
  using Real = vtkDoubleArray;
  addColumn<Whole>(*data, first, "id", [](std::size_t i) { return i; });
  addColumn<Whole>(*data, first, "parent", [&](std::size_t i) { return tree[i].parent; });
  addColumn<Byte>(*data, first, "lobe", [&](std::size_t i) { return tree[i].lobe; });
  addColumn<Byte>(*data, first, "side", [&](std::size_t i) { return side(tree[i].lobe); });
  addColumn<Byte>(*data, first, "segment", [&](std::size_t i) { return tree[i].segment; });
  addColumn<Whole>(*data, first, "generation",
                   [&](std::size_t i) { return columns.generation[i]; });
  addColumn<Whole>(*data, first, "horsfield_order",
                   [&](std::size_t i) { return columns.horsfieldOrder[i]; });
  addColumn<Whole>(*data, first, "strahler_order",
                   [&](std::size_t i) { return columns.strahlerOrder[i]; });
  addColumn<Real>(*data, first, "length_mm", [&](std::size_t i) { return lengthMm(tree[i]); });
  addColumn<Real>(*data, first, "diameter_mm",
                  [&](std::size_t i) { return 2.0 * tree[i].radiusMm; });
  addColumn<Real>(*data, first, "flow_fraction",
                  [&](std::size_t i) { return columns.flowFraction[i]; });
  addColumn<Real>(*data, first, "region_ml", [&](std::size_t i) { return columns.regionMl[i]; });
  addColumn<Byte>(*data, first, "terminal", [&](std::size_t i) { return columns.terminal[i]; });
  addColumn<Byte>(*data, first, "origin", [&](std::size_t i) { return tree[i].origin; });
  addColumn<Byte>(*data, first, "ending", [&](std::size_t i) { return tree[i].ending; });
  addColumn<Real>(*data, first, "supplied_ml", [&](std::size_t i) { return tree[i].suppliedMl; });
  for (const auto& [key, value] : metadata) setFieldText(*data, key, value);
  if (end - first < tree.size()) {
    setFieldText(*data, std::string(PieceKey),
                 "branches " + std::to_string(first) + " to " + std::to_string(end - 1) + " of " +
                     std::to_string(tree.size()));
  }
  setFieldText(*data, std::string(SpaceKey), "LPS");
  setFieldText(*data, std::string(UnitsKey), std::string(Units));
  return vtpText(*data);
}

std::string vtpText(const AirwayTree& tree, const Metadata& metadata) {
  return vtpText(tree, metadata, 0, tree.size());
}

}  // namespace pneuma
