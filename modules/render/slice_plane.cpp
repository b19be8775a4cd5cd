#include "render/slice_plane.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/units.h"

namespace pneuma {

ViewAxes axesOf(SlicePlane plane) {
  switch (plane) {
    case SlicePlane::Coronal:
      return {Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};
    case SlicePlane::Sagittal:
      return {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
    case SlicePlane::Axial:
      break;
  }
  return {Vec3::UnitX(), -Vec3::UnitY(), -Vec3::UnitZ()};
}

int normalAxis(SlicePlane plane) {
  return plane == SlicePlane::Axial ? 2 : plane == SlicePlane::Coronal ? 1 : 0;
}

std::string positionText(int axis, double mm) {
  constexpr std::array<std::array<char, 2>, 3> Letters = {{{'L', 'R'}, {'P', 'A'}, {'S', 'I'}}};
  const double rounded = std::round(mm * 10.0) / 10.0;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%c %.1f mm",
                Letters[static_cast<std::size_t>(axis)][rounded < 0.0 ? 1 : 0], std::abs(rounded));
  return text.data();
}

int SliceStack::nearest(double mm) const {
  const double slice = std::round((mm - firstMm) / stepMm);
  return static_cast<int>(std::clamp(slice, 0.0, std::max(0.0, count - 1.0)));
}

SliceStack sliceStack(const ImageGeometry& geometry, SlicePlane plane) {
  const int normal = normalAxis(plane);
  const AxisOrder order = patientAxes(geometry);
  const Box3 box = geometry.bounds();
  SliceStack stack;
  stack.plane = plane;
  stack.stepMm = geometry.spacing[order.from[static_cast<std::size_t>(normal)]];
  const double extent = box.max()[normal] - box.min()[normal];
  stack.count = std::max(1, static_cast<int>(std::lround(extent / stack.stepMm)));
  stack.firstMm =
      0.5 * (box.min()[normal] + box.max()[normal] - stack.stepMm * (stack.count - 1.0));
  return stack;
}

double obliqueDeg(const ImageGeometry& geometry) {
  const ImageGeometry along = turned(geometry, patientAxes(geometry));
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max(largest, angleBetween(along.direction.col(axis), Vec3::Unit(axis)));
  }
  return degrees(largest);
}

}  // namespace pneuma
