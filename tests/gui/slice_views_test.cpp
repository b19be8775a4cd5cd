#include "document/slice_views.h"

#include <QSignalSpy>

#include <gtest/gtest.h>

#include "render/generated_chest.h"

namespace pneuma {
namespace {

class SliceViewsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const test::GeneratedChest chest = test::generatedChest(test::chestGrid());
    ct = std::make_shared<const CtImage>(chest.ct);
    labels = std::make_shared<const LabelImage>(chest.labels);
    views.show(ct, labels);
  }

  std::shared_ptr<const CtImage> ct;
  std::shared_ptr<const LabelImage> labels;
  SliceViews views;
};

TEST_F(SliceViewsTest, GoThroughTheMiddleOfAVoxel) {
  views.moveTo(Vec3(10.2, -20.9, 33.0));
  EXPECT_EQ(views.point(), Vec3(10.5, -19.5, 32.5));
  EXPECT_EQ(views.slice(SlicePlane::Axial), 36);
  EXPECT_EQ(views.slice(SlicePlane::Coronal), 33);
  EXPECT_EQ(views.slice(SlicePlane::Sagittal), 63);
}

TEST_F(SliceViewsTest, StayInTheImage) {
  views.moveTo(Vec3(1e6, -1e6, 1e6));
  EXPECT_EQ(views.point(), Vec3(178.5, -118.5, 147.5));
  views.step(SlicePlane::Axial, 3);
  EXPECT_EQ(views.slice(SlicePlane::Axial), 59);
  views.step(SlicePlane::Axial, -1000);
  EXPECT_EQ(views.slice(SlicePlane::Axial), 0);
}

TEST_F(SliceViewsTest, TellOfAChangeOnceAndOfNoneNever) {
  QSignalSpy changes(&views, &SliceViews::changed);
  views.step(SlicePlane::Coronal, 1);
  EXPECT_EQ(changes.count(), 1);
  views.moveTo(views.point());
  views.setLook(views.look());
  views.show(ct, labels);
  EXPECT_EQ(changes.count(), 1);
}

TEST_F(SliceViewsTest, KeepPointAndZoomWhenLabelsCome) {
  views.moveTo(Vec3(10.5, -19.5, 32.5));
  const SliceFrame whole = views.frame(SlicePlane::Axial, 300, 200);
  views.setFrame(zoomed(whole, {100.0, 50.0}, 3.0));
  const SliceFrame before = views.frame(SlicePlane::Axial, 300, 200);
  views.show(ct, std::make_shared<const LabelImage>(*labels));
  EXPECT_EQ(views.frame(SlicePlane::Axial, 300, 200), before);
  EXPECT_EQ(views.point(), Vec3(10.5, -19.5, 32.5));
  views.show(std::make_shared<const CtImage>(*ct), labels);  // another CT
  EXPECT_NE(views.frame(SlicePlane::Axial, 300, 200), before);
}

TEST_F(SliceViewsTest, ZoomAPlaceThatStaysWhereItIs) {
  const SliceFrame whole = views.frame(SlicePlane::Sagittal, 300, 200);
  const Vec3 point = whole.pointAt({60.0, 150.0});
  views.setFrame(zoomed(whole, {60.0, 150.0}, 2.0));
  const SliceFrame closer = views.frame(SlicePlane::Sagittal, 300, 200);
  EXPECT_NEAR(closer.mmPerPixel, whole.mmPerPixel / 2.0, 1e-12);
  EXPECT_LT((closer.pointAt({60.0, 150.0}) - point).norm(), 1e-9);
  EXPECT_EQ(views.frame(SlicePlane::Axial, 300, 200).mmPerPixel,
            framedSlice(ct->geometry, SlicePlane::Axial, 0.0, 300, 200).mmPerPixel);
  views.resetFrame(SlicePlane::Sagittal);
  EXPECT_EQ(views.frame(SlicePlane::Sagittal, 300, 200), whole);
}

TEST_F(SliceViewsTest, NeverLoseTheImageFromSight) {
  SliceFrame frame = views.frame(SlicePlane::Axial, 300, 200);
  frame.centre += Vec3(5000.0, 5000.0, 0.0);
  frame.mmPerPixel = 1e-6;
  views.setFrame(frame);
  const SliceFrame shown = views.frame(SlicePlane::Axial, 300, 200);
  EXPECT_TRUE(ct->geometry.bounds().contains(0.999 * shown.centre));
  EXPECT_GT(shown.mmPerPixel, 0.02);
}

TEST_F(SliceViewsTest, SayWhatIsAtAPoint) {
  EXPECT_EQ(views.probe(Vec3(-70.0, 40.0, 40.0)).toStdString(),
            "R 70.0   P 40.0   S 40.0 mm   |   -860 HU   |   right lung");
  EXPECT_EQ(views.probe(Vec3(70.0, -80.0, -40.0)).toStdString(),
            "L 70.0   A 80.0   I 40.0 mm   |   40 HU");
  EXPECT_TRUE(views.probe(Vec3(0.0, 0.0, 500.0)).contains("outside the CT"));
}

}  // namespace
}  // namespace pneuma
