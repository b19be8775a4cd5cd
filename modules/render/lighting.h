#pragma once

#include <vtkSmartPointer.h>

#include "render/scene.h"

class vtkRenderPass;
class vtkRenderer;

namespace pneuma {

/// Three lights that move with the camera: a warm key from the upper left, a cool fill from the
/// right, a weak one from below.
void addLights(vtkRenderer* renderer);

/// Explicit passes: opaque, then plain alpha in the order of the actors, smoothed edges (FXAA).
/// Plain alpha of culled surfaces is clearer and much faster than depth peeling.
vtkSmartPointer<vtkRenderPass> addPasses(vtkRenderer* renderer);

/// Smooths edges or, to be fast, does not.
/// @param passes of addPasses(); those that smooth no edges stay as they are
void setSmooth(vtkRenderer* renderer, vtkRenderPass* passes, bool smooth);

void setBackground(vtkRenderer* renderer, Background background);

}  // namespace pneuma
