#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "core/units.h"
#include "render/baseline.h"
#include "render/generated_chest.h"
#include "render/slice_picture.h"

namespace pneuma {
namespace {

struct SliceCase {
  std::string name;
  SlicePlane plane;
  double positionMm;
  SliceLook look;
  bool oblique = false;
};

void PrintTo(const SliceCase& slice, std::ostream* out) { *out << slice.name; }

ImageGeometry obliqueGrid() {
  ImageGeometry geometry = test::chestGrid();
  geometry.direction = Eigen::AngleAxisd(radians(12.0), Vec3::UnitY()).toRotationMatrix();
  geometry.origin = -geometry.steps() * Vec3(59.5, 39.5, 29.5);
  return geometry;
}

class SliceImage : public testing::TestWithParam<SliceCase> {};

TEST_P(SliceImage, LooksLikeItsBaseline) {
  const SliceCase& slice = GetParam();
  const test::GeneratedChest chest =
      test::generatedChest(slice.oblique ? obliqueGrid() : test::chestGrid());
  SliceContents contents{&chest.ct, &chest.labels, {}, {}};
  if (slice.look.labels == LabelStyle::Filled) contents.crosshair = Vec3(-60.0, 20.0, 35.0);
  contents.markers = {Vec3(-61.5, 61.5, 17.5), Vec3(46.5, -31.5, 57.5)};
  const SliceFrame frame = framedSlice(chest.ct.geometry, slice.plane, slice.positionMm, 480, 360);
  test::expectLikeBaseline(slicePicture(contents, frame, slice.look), slice.name);
}

INSTANTIATE_TEST_SUITE_P(
    Slice, SliceImage,
    testing::Values(SliceCase{"slice_axial", SlicePlane::Axial, 17.5, {}},
                    SliceCase{"slice_coronal", SlicePlane::Coronal, -1.5, {}},
                    SliceCase{"slice_sagittal", SlicePlane::Sagittal, 46.5, {}},
                    SliceCase{
                        "slice_outlined",
                        SlicePlane::Axial,
                        57.5,
                        {.window = greyWindow("mediastinum"), .labels = LabelStyle::Outlined}},
                    SliceCase{"slice_threshold",
                              SlicePlane::Coronal,
                              -1.5,
                              {.labels = LabelStyle::Hidden, .highlight = HuBand{-950.0, -400.0}}},
                    SliceCase{"slice_oblique", SlicePlane::Coronal, 0.0, {}, true}),
    [](const testing::TestParamInfo<SliceCase>& each) { return each.param.name; });

}  // namespace
}  // namespace pneuma
