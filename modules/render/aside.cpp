#include "render/aside.h"

#include <cmath>

#include <vtkCamera.h>

#include "core/units.h"

namespace pneuma {

Aside::Aside(vtkCamera& camera, double mm, double aspect) : camera_(camera) {
  camera.GetPosition(eye_.data());
  camera.GetFocalPoint(focus_.data());
  const Vec3 ahead = (focus_ - eye_).normalized();
  const Vec3 step = mm * ahead.cross(Vec3(camera.GetViewUp())).normalized();
  const double halfWidth =
      (focus_ - eye_).norm() * std::tan(radians(0.5 * camera.GetViewAngle())) * aspect;
  const Vec3 eye = eye_ + step;
  const Vec3 focus = focus_ + step;
  camera.SetPosition(eye.data());
  camera.SetFocalPoint(focus.data());
  camera.SetWindowCenter(-mm / halfWidth, 0.0);
}

Aside::~Aside() {
  camera_.SetPosition(eye_.data());
  camera_.SetFocalPoint(focus_.data());
  camera_.SetWindowCenter(0.0, 0.0);
}

}  // namespace pneuma
