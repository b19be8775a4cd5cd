#pragma once

#include <vector>

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include "render/breathing_scene.h"
#include "render/scene.h"

class vtkRenderer;

namespace pneuma {

/// Balls in the lungs, translucent: parts that are stiffer or softer.
class BallLayer {
 public:
  explicit BallLayer(vtkRenderer* renderer) : renderer_(renderer) {}

  void setBalls(std::vector<SceneBall> balls);

  void setBreath(const BreathScale& scale);

 private:
  void place(std::size_t index);

  vtkRenderer* renderer_;
  std::vector<SceneBall> balls_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
  BreathScale scale_;
};

}  // namespace pneuma
