#pragma once

#include <vector>

#include <vtkSmartPointer.h>

#include "core/triangle_mesh.h"
#include "render/tube_mesh.h"

class vtkPolyData;

namespace pneuma {

/// Twice the sum of the area vectors of the triangles around each point, mm^2: its smooth normal,
/// not of length 1.
std::vector<Vec3> areaVectors(const TriangleMesh& mesh);

/// A surface with smooth normals, weighted by the area of the triangles around each point. Where
/// there are far more triangles than points, copies of a triangle are left out.
vtkSmartPointer<vtkPolyData> polyDataOf(const TriangleMesh& mesh);

vtkSmartPointer<vtkPolyData> polyDataOf(const TubeMesh& mesh);

vtkSmartPointer<vtkPolyData> polyDataOf(const LineMesh& mesh);

}  // namespace pneuma
