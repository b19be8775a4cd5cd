#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/image.h"
#include "render/camera.h"

namespace pneuma {

/// The three planes across a patient, each as radiologists see it: axial from the feet and coronal
/// from the front, the patient's right on the left of the picture; sagittal with the front on the
/// left.
enum class SlicePlane { Axial, Coronal, Sagittal };

inline constexpr std::array<SlicePlane, 3> SlicePlanes = {SlicePlane::Axial, SlicePlane::Coronal,
                                                          SlicePlane::Sagittal};

constexpr std::array<std::string_view, 3> choices(SlicePlane) {
  return {"axial", "coronal", "sagittal"};
}

/// Directions of its pictures.
ViewAxes axesOf(SlicePlane plane);

/// The LPS axis across the plane: 2 (up) for axial, 1 (back) for coronal, 0 (left) for sagittal.
int normalAxis(SlicePlane plane);

/// A place along an LPS axis as clinicians say it: "S 210.5 mm", "R 62.0 mm".
/// @param axis 0 right-left, 1 anterior-posterior, 2 inferior-superior
std::string positionText(int axis, double mm);

/// The slices that an image has in one plane, counted from 0 along the LPS axis across it: from
/// the feet up, from front to back, from right to left.
struct SliceStack {
  SlicePlane plane = SlicePlane::Axial;
  int count = 0;
  double firstMm = 0.0;
  double stepMm = 1.0;

  double positionMm(int slice) const { return firstMm + stepMm * slice; }

  /// The slice nearest to a position, of those that there are.
  int nearest(double mm) const;
};

/// Slices through the voxels' centres. Where the image lies oblique in the patient, its extent is
/// cut at the spacing of the axis that runs nearest to the plane's normal.
SliceStack sliceStack(const ImageGeometry& geometry, SlicePlane plane);

/// The largest angle between an axis of the image and the axis of the patient that it stands for,
/// degrees. Pictures of an image with more than ObliqueFromDeg say that they are resampled.
double obliqueDeg(const ImageGeometry& geometry);
inline constexpr double ObliqueFromDeg = 0.1;

}  // namespace pneuma
