#include "render/slice_frame.h"

#include <algorithm>
#include <cmath>

namespace pneuma {

Vec3 SliceFrame::pointAt(const PicturePoint& p) const {
  const ViewAxes axes = axesOf(plane);
  return centre + mmPerPixel * ((p.x - 0.5 * width) * axes.right - (p.y - 0.5 * height) * axes.up);
}

PicturePoint SliceFrame::drawnAt(const Vec3& point) const {
  const ViewAxes axes = axesOf(plane);
  const Vec3 offset = (point - centre) / mmPerPixel;
  return {0.5 * width + offset.dot(axes.right), 0.5 * height - offset.dot(axes.up)};
}

SliceFrame framedSlice(const ImageGeometry& geometry, SlicePlane plane, double positionMm,
                       int width, int height) {
  const ViewAxes axes = axesOf(plane);
  const Box3 box = geometry.bounds();
  SliceFrame frame{plane, box.center(), 1.0, width, height};
  frame.centre[normalAxis(plane)] = positionMm;
  frame.mmPerPixel = std::max(std::abs(box.sizes().dot(axes.right)) / width,
                              std::abs(box.sizes().dot(axes.up)) / height);
  return frame;
}

SliceFrame zoomed(SliceFrame frame, const PicturePoint& fixed, double factor) {
  const Vec3 point = frame.pointAt(fixed);
  const Vec3 offset = frame.centre - point;
  frame.mmPerPixel /= factor;
  frame.centre = point + offset / factor;
  return frame;
}

}  // namespace pneuma
