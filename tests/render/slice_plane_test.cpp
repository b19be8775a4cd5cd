#include "render/slice_plane.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/units.h"
#include "render/slice_frame.h"

namespace pneuma {
namespace {

ImageGeometry grid() {
  ImageGeometry geometry;
  geometry.size = {40, 50, 20};
  geometry.spacing = Vec3(1.0, 2.0, 5.0);
  geometry.origin = Vec3(-10.0, 30.0, 200.0);
  return geometry;
}

TEST(SlicePlane, LooksAsRadiologistsDo) {
  for (const SlicePlane plane : SlicePlanes) {
    const ViewAxes axes = axesOf(plane);
    EXPECT_EQ(axes.right.cross(axes.up), axes.towardsEye);
    EXPECT_EQ(std::abs(axes.towardsEye[normalAxis(plane)]), 1.0);
  }
  EXPECT_EQ(orientationLetters(axesOf(SlicePlane::Axial).right), "L");
  EXPECT_EQ(orientationLetters(axesOf(SlicePlane::Axial).towardsEye), "I");
  EXPECT_EQ(orientationLetters(axesOf(SlicePlane::Coronal).right), "L");
  EXPECT_EQ(orientationLetters(axesOf(SlicePlane::Coronal).towardsEye), "A");
  EXPECT_EQ(orientationLetters(axesOf(SlicePlane::Sagittal).right), "P");
}

TEST(SlicePlane, SaysPositionsByLetter) {
  EXPECT_EQ(positionText(0, 12.34), "L 12.3 mm");
  EXPECT_EQ(positionText(0, -12.34), "R 12.3 mm");
  EXPECT_EQ(positionText(1, -7.0), "A 7.0 mm");
  EXPECT_EQ(positionText(2, -210.55), "I 210.6 mm");
  EXPECT_EQ(positionText(2, -0.01), "S 0.0 mm");  // never "I 0.0"
}

TEST(SliceStack, GoesThroughTheVoxelsWhateverTheirOrder) {
  ImageGeometry geometry = grid();
  for (int turn = 0; turn < 2; ++turn) {
    const SliceStack axial = sliceStack(geometry, SlicePlane::Axial);
    EXPECT_EQ(axial.count, 20);
    EXPECT_NEAR(axial.firstMm, 200.0, 1e-9);
    EXPECT_NEAR(axial.positionMm(19), 295.0, 1e-9);
    EXPECT_EQ(sliceStack(geometry, SlicePlane::Coronal).count, 50);
    EXPECT_NEAR(sliceStack(geometry, SlicePlane::Coronal).firstMm, 30.0, 1e-9);
    EXPECT_EQ(sliceStack(geometry, SlicePlane::Sagittal).count, 40);
    geometry = turned(geometry, {{2, 0, 1}, {true, false, true}});
  }
}

TEST(SliceStack, FindsTheNearestSliceThatThereIs) {
  const SliceStack stack = sliceStack(grid(), SlicePlane::Axial);
  EXPECT_EQ(stack.nearest(212.4), 2);
  EXPECT_EQ(stack.nearest(212.6), 3);
  EXPECT_EQ(stack.nearest(-1e9), 0);
  EXPECT_EQ(stack.nearest(1e9), 19);
}

TEST(SliceStack, OfAnObliqueImageCoversItsExtent) {
  ImageGeometry geometry = grid();
  geometry.direction = Eigen::AngleAxisd(radians(20.0), Vec3::UnitX()).toRotationMatrix();
  EXPECT_NEAR(obliqueDeg(geometry), 20.0, 1e-9);
  EXPECT_NEAR(obliqueDeg(grid()), 0.0, 1e-9);
  const SliceStack axial = sliceStack(geometry, SlicePlane::Axial);
  const Box3 box = geometry.bounds();
  EXPECT_EQ(axial.stepMm, 5.0);
  EXPECT_NEAR(axial.firstMm - box.min().z(), box.max().z() - axial.positionMm(axial.count - 1),
              1e-9);
  EXPECT_LT(axial.firstMm - box.min().z(), axial.stepMm);
}

TEST(SliceFrame, MapsThereAndBack) {
  for (const SlicePlane plane : SlicePlanes) {
    const SliceFrame frame = framedSlice(grid(), plane, 42.0, 300, 200);
    const Vec3 point = frame.pointAt({17.5, 120.0});
    EXPECT_NEAR(point[normalAxis(plane)], 42.0, 1e-9);
    EXPECT_NEAR(frame.drawnAt(point).x, 17.5, 1e-9);
    EXPECT_NEAR(frame.drawnAt(point).y, 120.0, 1e-9);
  }
}

TEST(SliceFrame, ShowsTheWholeImageAtOneScale) {
  const SliceFrame frame = framedSlice(grid(), SlicePlane::Coronal, 42.0, 300, 200);
  const Box3 box = grid().bounds();
  const PicturePoint low = frame.drawnAt(box.min());
  const PicturePoint high = frame.drawnAt(box.max());
  EXPECT_NEAR(high.y, 0.0, 1e-9);  // 100 mm high in 200 pixels
  EXPECT_NEAR(low.y, 200.0, 1e-9);
  EXPECT_NEAR(high.x - low.x, 80.0, 1e-9);  // 40 mm
  EXPECT_NEAR(low.x, 110.0, 1e-9);
}

TEST(SliceFrame, ZoomsAboutAPoint) {
  const SliceFrame frame = framedSlice(grid(), SlicePlane::Sagittal, -3.0, 300, 200);
  const SliceFrame closer = zoomed(frame, {40.0, 150.0}, 2.0);
  EXPECT_NEAR(closer.mmPerPixel, frame.mmPerPixel / 2.0, 1e-12);
  EXPECT_LT((closer.pointAt({40.0, 150.0}) - frame.pointAt({40.0, 150.0})).norm(), 1e-9);
  EXPECT_EQ(closer.positionMm(), -3.0);
}

}  // namespace
}  // namespace pneuma
