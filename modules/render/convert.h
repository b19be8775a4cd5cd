#pragma once

#include <vtkSmartPointer.h>

#include "core/triangle_mesh.h"
#include "render/tube_mesh.h"

class vtkPolyData;

namespace pneuma {

/// A surface with smooth normals, weighted by the area of the triangles around each point.
vtkSmartPointer<vtkPolyData> polyDataOf(const TriangleMesh& mesh);

vtkSmartPointer<vtkPolyData> polyDataOf(const TubeMesh& mesh);

vtkSmartPointer<vtkPolyData> polyDataOf(const LineMesh& mesh);

}  // namespace pneuma
