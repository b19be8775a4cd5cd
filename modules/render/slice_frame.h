#pragma once

#include "render/slice_plane.h"

namespace pneuma {

/// A point of a picture, pixels from its upper left corner to the right and down. The centre of
/// the first pixel is (0.5, 0.5).
struct PicturePoint {
  double x = 0.0;
  double y = 0.0;
};

/// Which part of which slice a picture shows.
struct SliceFrame {
  SlicePlane plane = SlicePlane::Axial;
  Vec3 centre = Vec3::Zero();  ///< in the middle of the picture, LPS, mm; also says which slice
  double mmPerPixel = 1.0;     ///< both ways
  int width = 512;             ///< pixels
  int height = 512;

  bool operator==(const SliceFrame&) const = default;

  /// Where the slice lies along its normalAxis(), mm.
  double positionMm() const { return centre[normalAxis(plane)]; }

  /// The point of the slice that is drawn there.
  Vec3 pointAt(const PicturePoint& p) const;

  /// Where a point is drawn, seen along the normal.
  PicturePoint drawnAt(const Vec3& point) const;
};

/// The frame in which all of an image is seen, in its middle. @param width, height pixels
SliceFrame framedSlice(const ImageGeometry& geometry, SlicePlane plane, double positionMm,
                       int width, int height);

/// The same frame with its picture's point `fixed` kept where it is while everything around grows
/// by `factor`.
SliceFrame zoomed(SliceFrame frame, const PicturePoint& fixed, double factor);

}  // namespace pneuma
