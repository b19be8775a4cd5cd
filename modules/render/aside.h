#pragma once

#include "core/math.h"

class vtkCamera;

namespace pneuma {

/// A camera that stands aside of where it stood, looks the same way and has its former focus in the
/// same place of its picture (off-axis); put back in the end.
class Aside {
 public:
  /// @param mm to the camera's right
  /// @param aspect width of the picture by its height
  Aside(vtkCamera& camera, double mm, double aspect);
  ~Aside();
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

 private:
  vtkCamera& camera_;
  Vec3 eye_;
  Vec3 focus_;
};

}  // namespace pneuma
