#pragma once

#include "render/breath_attributes.h"
#include "render/breathing_scene.h"

class vtkActor;
class vtkPolyData;

namespace pneuma {

/// Lets the actor's points move. Call it after its mapper has the data, which is given once more.
void letBreathe(vtkActor* actor, vtkPolyData* data, const BreathAttributes& attributes);

/// Moves them. Costs nothing but the next frame.
void setBreath(vtkActor* actor, const BreathScale& scale);

}  // namespace pneuma
