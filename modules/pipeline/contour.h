#pragma once

#include "core/triangle_mesh.h"

class vtkImageData;

namespace pneuma {

/// The closed surface where the image's scalars are `value`, oriented outwards.
TriangleMesh contourOf(vtkImageData& image, double value);

}  // namespace pneuma
