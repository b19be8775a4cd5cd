#pragma once

#include <optional>
#include <vector>

#include "core/image.h"
#include "render/fissure_scene.h"
#include "render/grey_window.h"
#include "render/picture.h"
#include "render/slice_frame.h"

namespace pneuma {

/// Pictures of slices are put together here pixel by pixel, without VTK's renderers: a slice takes
/// a millisecond or two, needs no display and no graphics card, is the same everywhere, and every
/// direction matrix is honoured (vtkImageResliceMapper draws oblique images in the wrong place and
/// says nothing).

enum class LabelStyle { Hidden, Outlined, Filled };

constexpr std::array<std::string_view, 3> choices(LabelStyle) {
  return {"hidden", "outlined", "filled"};
}

/// Radiodensities from low to high, HU.
struct HuBand {
  double low = 0.0;
  double high = 0.0;

  bool operator==(const HuBand&) const = default;
};

/// How a slice looks; the same for `pneuma render`, the window and image tests.
struct SliceLook {
  GreyWindow window{};
  LabelStyle labels = LabelStyle::Filled;
  double opacity = 0.35;              ///< of the labels' inside
  std::optional<HuBand> highlight{};  ///< coloured inside the patient, in place of filled labels
  bool annotations = true;            ///< title, letters, scale bar, window
  double pixelRatio = 1.0;            ///< pixels to a logical pixel: how large letters are

  bool operator==(const SliceLook&) const = default;
};

/// What a slice is cut through. The images may have any axes, each its own; none is kept.
struct SliceContents {
  const CtImage* ct = nullptr;         ///< null: a black ground
  const LabelImage* labels = nullptr;  ///< null: none
  std::vector<Vec3> markers{};         ///< ringed where they lie within half a slice
  std::optional<Vec3> crosshair{};
  const SliceFissures* fissures = nullptr;  ///< drawn in the labels' lungs; null: none
};

/// Interpolates the CT linearly, averaging where pixels are larger than voxels; labels are the
/// nearest voxel's. Nothing is drawn outside the images.
Picture slicePicture(const SliceContents& contents, const SliceFrame& frame,
                     const SliceLook& look = {});

/// What the voxel around a point holds: its radiodensity, HU, or its label. None outside the image.
std::optional<int> huAt(const CtImage& ct, const Vec3& point);
std::optional<std::uint8_t> labelAt(const LabelImage& labels, const Vec3& point);

}  // namespace pneuma
