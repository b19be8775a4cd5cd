#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QSlider>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include "io/volume_file.h"
#include "machine_load.h"
#include "render/generated_chest.h"
#include "widgets/ct_views.h"
#include "widgets/slice_view.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

/// The window with a CT, written as a file and opened like anybody's.
class CtWindowTest : public testing::WindowTest {
 protected:
  void openCt() {
    writeVolume(inFolder("ct.nii.gz"), test::generatedChest(test::chestGrid()).ct);
    window.open({inFolder("ct.nii.gz")});
    ASSERT_TRUE(idle());
    ASSERT_FALSE(find<QWidget>("errorCard").isVisible())
        << find<QLabel>("errorSentence").text().toStdString();
    QTest::qWait(50);
  }

  SliceView& slice(const char* name) { return find<SliceView>(name); }

  SliceViews& views() { return window.slices(); }

  void drag(SliceView& view, const QPoint& from, const QPoint& to, Qt::MouseButton button,
            Qt::KeyboardModifiers modifiers = {}) {
    QTest::mousePress(&view, button, modifiers, from);
    QMouseEvent move(QEvent::MouseMove, to, view.mapToGlobal(to), Qt::NoButton, button, modifiers);
    QApplication::sendEvent(&view, &move);
    QTest::mouseRelease(&view, button, modifiers, to);
  }

  void wheel(SliceView& view, int notches, Qt::KeyboardModifiers modifiers = {}) {
    const QPoint at = view.rect().center();
    QWheelEvent event(at, view.mapToGlobal(at), {}, QPoint(0, 120 * notches), Qt::NoButton,
                      modifiers, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view, &event);
  }
};

TEST_F(CtWindowTest, ShowsThreeSlicesBesideTheSceneView) {
  EXPECT_FALSE(slice("slice_axial").isVisible());
  openCt();
  for (const char* name : {"slice_axial", "slice_coronal", "slice_sagittal", "sceneView"}) {
    EXPECT_TRUE(find<QWidget>(name).isVisible()) << name;
    EXPECT_GT(find<QWidget>(name).width(), 250) << name;
    EXPECT_GT(find<QWidget>(name).height(), 200) << name;
  }
  EXPECT_TRUE(find<QWidget>("sliceBar").isVisible());
  EXPECT_EQ(find<QSlider>("sliceBar_axial").maximum(), 59);
}

TEST_F(CtWindowTest, SurfacesAloneLeaveAllTheRoomToTheSceneView) {
  openChestFromFiles();
  EXPECT_FALSE(slice("slice_axial").isVisible());
  EXPECT_FALSE(find<QWidget>("sliceBar").isVisible());
  EXPECT_EQ(find<QWidget>("sceneView").size(), find<QWidget>("ctViews").size());
}

TEST_F(CtWindowTest, AClickMovesThePointInAllViews) {
  openCt();
  const Vec3 wanted(-61.5, 31.5, views().point().z());
  QTest::mouseClick(&slice("slice_axial"), Qt::LeftButton, {},
                    slice("slice_axial").positionOf(wanted));
  // A pixel is less than a voxel here.
  EXPECT_LT((views().point() - wanted).cwiseAbs().maxCoeff(), 3.1);
  EXPECT_EQ(find<QSlider>("sliceBar_coronal").value(), views().slice(SlicePlane::Coronal));
  EXPECT_EQ(find<QSlider>("sliceBar_sagittal").value(), views().slice(SlicePlane::Sagittal));
  const Vec3 lower(views().point().x(), -25.5, -62.5);
  drag(slice("slice_sagittal"), slice("slice_sagittal").positionOf(views().point()),
       slice("slice_sagittal").positionOf(lower), Qt::LeftButton);
  EXPECT_LT((views().point() - lower).cwiseAbs().maxCoeff(), 5.1);
}

TEST_F(CtWindowTest, WheelKeysAndBarGoThroughTheSlices) {
  openCt();
  const int start = views().slice(SlicePlane::Axial);
  wheel(slice("slice_axial"), 2);
  EXPECT_EQ(views().slice(SlicePlane::Axial), start + 2);
  wheel(slice("slice_axial"), -1, Qt::ShiftModifier);
  EXPECT_EQ(views().slice(SlicePlane::Axial), start - 3);
  QTest::keyClick(&slice("slice_axial"), Qt::Key_Up);
  EXPECT_EQ(views().slice(SlicePlane::Axial), start - 2);
  find<QSlider>("sliceBar_coronal").setValue(7);
  EXPECT_EQ(views().slice(SlicePlane::Coronal), 7);
}

TEST_F(CtWindowTest, KeysAndDraggingChangeTheWindow) {
  openCt();
  SliceView& axial = slice("slice_axial");
  axial.setFocus();
  QTest::keyClick(&axial, Qt::Key_F7);
  EXPECT_EQ(views().look().window, (GreyWindow{350.0, 40.0}));
  EXPECT_EQ(find<QComboBox>("windowPreset").currentText(), "Mediastinum");
  QTest::keyPress(&axial, Qt::Key_W);
  drag(axial, {100, 100}, {150, 90}, Qt::LeftButton);
  QTest::keyRelease(&axial, Qt::Key_W);
  EXPECT_EQ(views().look().window, (GreyWindow{550.0, 0.0}));
  EXPECT_EQ(find<QComboBox>("windowPreset").currentText(), "Custom");
  find<QDoubleSpinBox>("windowLevel").setValue(-500.0);
  EXPECT_EQ(views().look().window, (GreyWindow{550.0, -500.0}));
}

TEST_F(CtWindowTest, ZoomsPansAndGoesBack) {
  openCt();
  SliceView& coronal = slice("slice_coronal");
  const QImage before = coronal.picture();
  wheel(coronal, 3, Qt::ControlModifier);
  const QImage closer = coronal.picture();
  EXPECT_NE(closer, before);
  drag(coronal, {100, 100}, {140, 120}, Qt::MiddleButton);
  EXPECT_NE(coronal.picture(), closer);
  drag(coronal, {100, 100}, {100, 60}, Qt::RightButton);
  QTest::keyClick(&coronal, Qt::Key_R);
  EXPECT_EQ(coronal.picture(), before);
}

TEST_F(CtWindowTest, ADoubleClickGivesOneViewAllTheRoom) {
  openCt();
  QTest::mouseDClick(&slice("slice_sagittal"), Qt::LeftButton);
  EXPECT_FALSE(slice("slice_axial").isVisible());
  EXPECT_FALSE(find<QWidget>("sceneView").isVisible());
  QTest::qWait(20);
  EXPECT_GT(slice("slice_sagittal").width(), find<QWidget>("ctViews").width() - 40);
  QTest::mouseDClick(&slice("slice_sagittal"), Qt::LeftButton);
  EXPECT_TRUE(slice("slice_axial").isVisible());
}

TEST_F(CtWindowTest, TheStatusLineSaysWhatThePointerIsOn) {
  openCt();
  SliceView& axial = slice("slice_axial");
  views().moveTo(Vec3(0.0, 0.0, 40.0));
  const QPoint at = axial.positionOf(Vec3(-60.0, 40.0, 40.0));
  QMouseEvent move(QEvent::MouseMove, at, axial.mapToGlobal(at), Qt::NoButton, Qt::NoButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&axial, &move);
  const QString text = find<QLabel>("statusMessage").text();
  EXPECT_TRUE(text.startsWith("R ")) << text.toStdString();
  EXPECT_TRUE(text.contains("-860 HU")) << text.toStdString();
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(&axial, &leave);
  EXPECT_FALSE(find<QLabel>("statusMessage").text().contains("HU"));
}

TEST_F(CtWindowTest, LooksForLungsByItselfAndShowsThem) {
  openCt();
  const LungModel& model = window.document().model();
  ASSERT_NE(model.lungs, nullptr);
  EXPECT_GT(model.lungs->right.volumeMl, 1000.0);
  EXPECT_TRUE(find<SheetCard>("foundLungs").text().contains("Right lung"));
  EXPECT_TRUE(find<QLabel>("statusMessage").text().contains("Found the lungs"));
  const QImage filled = slice("slice_coronal").picture();
  find<QAction>("actionOutlines").trigger();
  const QImage outlined = slice("slice_coronal").picture();
  find<QAction>("actionOverlay").trigger();
  const QImage plain = slice("slice_coronal").picture();
  EXPECT_NE(filled, outlined);
  EXPECT_NE(outlined, plain);
  find<QAction>("actionUndo").trigger();
  EXPECT_EQ(window.document().model().labels, nullptr);
  EXPECT_NE(window.document().model().ct, nullptr);
}

TEST_F(CtWindowTest, TheThresholdIsSeenOnTheSlicesAtOnce) {
  openCt();
  click("stepLungs");
  const QImage before = slice("slice_axial").picture();
  QElapsedTimer clock;
  clock.start();
  find<QSlider>("threshold").setValue(-700);
  const QImage preview = slice("slice_axial").picture();
  const auto elapsedMs = static_cast<double>(clock.elapsed());  // before the load is measured
  EXPECT_LT(elapsedMs, 300.0 * machineLoad());
  EXPECT_NE(preview, before);
  EXPECT_EQ(find<QDoubleSpinBox>("option_threshold").value(), -700.0);
  EXPECT_TRUE(find<QLabel>("lungsNote").text().contains("Changed since"));
  click("findLungs");
  ASSERT_TRUE(idle());
  EXPECT_EQ(window.document().snapshot().lungOptions.thresholdHu, -700.0);
  EXPECT_FALSE(views().look().highlight.has_value());
}

TEST_F(CtWindowTest, LabelsOfAFileAreLaidOverTheCtThatIsOpen) {
  openCt();
  writeVolume(inFolder("labels.nii.gz"), test::generatedChest(test::chestGrid()).labels);
  window.open({inFolder("labels.nii.gz")});
  ASSERT_TRUE(idle());
  EXPECT_EQ(window.document().model().lungs, nullptr);
  EXPECT_NE(window.document().model().labels, nullptr);
  EXPECT_NE(window.document().model().ct, nullptr);
}

TEST_F(CtWindowTest, StepsAreThoseThatTheDataHas) {
  EXPECT_TRUE(find<QWidget>("stepLungs").isVisible());
  openChestFromFiles();
  EXPECT_FALSE(find<QWidget>("stepLungs").isVisible());
  QTest::keyClick(&window, Qt::Key_2);
  EXPECT_TRUE(find<QAbstractButton>("stepAirways").isChecked());
  openCt();
  EXPECT_TRUE(find<QWidget>("stepLungs").isVisible());
  QTest::keyClick(&window, Qt::Key_2);
  EXPECT_TRUE(find<QAbstractButton>("stepLungs").isChecked());
}

TEST_F(CtWindowTest, ScrollsFastEnough) {
  ImageGeometry geometry;
  geometry.size = {512, 512, 20};
  geometry.spacing = Vec3(0.7, 0.7, 2.5);
  writeVolume(inFolder("large.nrrd"), test::generatedChest(geometry).ct);
  window.open({inFolder("large.nrrd")});
  ASSERT_TRUE(idle());
  QElapsedTimer clock;
  clock.start();
  for (int i = 0; i < 10; ++i) {
    views().step(SlicePlane::Axial, i % 2 == 0 ? 1 : -1);
    QApplication::processEvents();
  }
  // Three linked views, at least 15 steps a second.
  const auto elapsedMs = static_cast<double>(clock.elapsed());  // before the load is measured
  EXPECT_LT(elapsedMs, 670.0 * machineLoad());
}

}  // namespace
}  // namespace pneuma
