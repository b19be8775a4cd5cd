#pragma once

#include <vtkSmartPointer.h>

#include "render/picture.h"

class vtkImageData;

namespace pneuma {

/// A picture as VTK's writers take it: rows from below.
vtkSmartPointer<vtkImageData> imageDataOf(const Picture& picture);

}  // namespace pneuma
