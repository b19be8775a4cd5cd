// The tools of the step Lungs, driven by mouse and keys.
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QMouseEvent>

#include <gtest/gtest.h>

#include "io/volume_file.h"
#include "machine_load.h"
#include "render/generated_chest.h"
#include "widgets/ct_views.h"
#include "widgets/slice_view.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

class LungWindowTest : public testing::WindowTest {
 protected:
  void openChest(const ImageGeometry& geometry) {
    writeVolume(inFolder("ct.nrrd"), test::generatedChest(geometry).ct);
    window.open({inFolder("ct.nrrd")});
    ASSERT_TRUE(idle());
    QTest::qWait(50);
    click("stepLungs");
  }

  SliceView& view(const char* name) { return find<SliceView>(name); }

  void move(SliceView& on, const QPoint& to, Qt::MouseButtons buttons) {
    QMouseEvent event(QEvent::MouseMove, to, on.mapToGlobal(to), Qt::NoButton, buttons,
                      Qt::NoModifier);
    QApplication::sendEvent(&on, &event);
  }

  void stroke(SliceView& on, const Vec3& from, const Vec3& to) {
    QTest::mousePress(&on, Qt::LeftButton, {}, on.positionOf(from));
    move(on, on.positionOf(0.5 * (from + to)), Qt::LeftButton);
    move(on, on.positionOf(to), Qt::LeftButton);
    QTest::mouseRelease(&on, Qt::LeftButton, {}, on.positionOf(to));
  }

  std::size_t edits() {
    const auto& corrections = window.document().model().corrections;
    return corrections ? corrections->edits.size() : 0;
  }
};

TEST_F(LungWindowTest, PaintsInAllThreeViews) {
  openChest(test::chestGrid());
  const double before = window.document().model().lungs->left.volumeMl;
  find<QAction>("actionViewL").trigger();
  const ViewDirection from = window.view().lookingFrom();
  click("brush");
  EXPECT_TRUE(find<QAbstractButton>("brush").isChecked());
  find<QDoubleSpinBox>("brushRadius").setValue(12.0);
  find<QComboBox>("brushLung").setCurrentText("Left");
  window.slices().moveTo(Vec3(10.0, 20.0, -100.0));
  const Vec3 here = window.slices().point();
  stroke(view("slice_axial"), here, here + Vec3(20.0, 0.0, 0.0));
  EXPECT_EQ(window.document().undoName(), "paint left lung");
  EXPECT_EQ(window.slices().point(), here) << "a brush does not move the crosshair";
  stroke(view("slice_coronal"), here, here + Vec3(0.0, 0.0, -10.0));
  stroke(view("slice_sagittal"), here, here + Vec3(0.0, 30.0, 0.0));
  EXPECT_EQ(edits(), 3U);
  ASSERT_TRUE(idle());
  EXPECT_GT(window.document().model().lungs->left.volumeMl, before + 10.0);
  EXPECT_NEAR(window.view().lookingFrom().azimuthDeg, from.azimuthDeg, 1e-6)
      << "the 3-D view stays where it is";
  EXPECT_TRUE(find<QLabel>("correctionsNote").text().contains("3 edits"));
  EXPECT_TRUE(find<QWidget>("stepLungs").accessibleName().contains("corrected by hand"));
  EXPECT_TRUE(find<QAction>("actionUndo").text().contains("paint left lung"));
  find<QAction>("actionUndo").trigger();
  EXPECT_EQ(edits(), 2U);
  ASSERT_TRUE(idle());
}

TEST_F(LungWindowTest, TheCircleIsSeenWhereThePointerIs) {
  openChest(test::chestGrid());
  SliceView& axial = view("slice_axial");
  const QPoint middle = axial.rect().center();
  move(axial, middle, Qt::NoButton);
  QTest::qWait(30);
  const QImage plain = axial.grab().toImage();
  click("eraser");
  move(axial, middle, Qt::NoButton);
  QTest::qWait(30);
  EXPECT_NE(axial.grab().toImage(), plain);
  find<QAction>("actionLargerBrush").trigger();
  EXPECT_EQ(find<QDoubleSpinBox>("brushRadius").value(), 8.0);
  find<QAction>("actionSmallerBrush").trigger();
  find<QAction>("actionSmallerBrush").trigger();
  EXPECT_EQ(find<QDoubleSpinBox>("brushRadius").value(), 4.0);
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(&axial, &leave);
  QTest::qWait(30);
  EXPECT_EQ(axial.grab().toImage(), plain);
}

TEST_F(LungWindowTest, KeysTakeToolsAndEscPutsThemAway) {
  EXPECT_FALSE(find<QAction>("actionBrush").isEnabled());
  openChest(test::chestGrid());
  SliceView& axial = view("slice_axial");
  axial.setFocus();
  QTest::keyClick(&axial, Qt::Key_D);
  EXPECT_EQ(window.lungEditor().tool(), LungEditor::Tool::Brush);
  QTest::keyClick(&axial, Qt::Key_D, Qt::ShiftModifier);
  EXPECT_EQ(window.lungEditor().tool(), LungEditor::Tool::Eraser);
  QTest::keyClick(&axial, Qt::Key_T);
  EXPECT_EQ(window.lungEditor().tool(), LungEditor::Tool::Seed);
  EXPECT_FALSE(find<QAction>("actionLargerBrush").isEnabled());
  QTest::keyClick(&window, Qt::Key_Escape);
  EXPECT_EQ(window.lungEditor().tool(), LungEditor::Tool::None);
  // Esc gives the stroke up first, then the brush.
  QTest::keyClick(&axial, Qt::Key_D);
  QTest::mousePress(&axial, Qt::LeftButton, {}, axial.rect().center());
  QTest::keyClick(&window, Qt::Key_Escape);
  QTest::mouseRelease(&axial, Qt::LeftButton, {}, axial.rect().center());
  EXPECT_EQ(edits(), 0U);
  EXPECT_EQ(window.lungEditor().tool(), LungEditor::Tool::Brush);
  click("stepLobes");
  EXPECT_EQ(window.lungEditor().tool(), LungEditor::Tool::None);
  EXPECT_FALSE(find<QAction>("actionBrush").isEnabled());
}

TEST_F(LungWindowTest, AMoveOfTheBrushIsSeenAtOnce) {
  ImageGeometry geometry;
  geometry.size = {512, 512, 60};
  geometry.spacing = Vec3(0.7, 0.7, 2.5);
  geometry.origin = Vec3(-179.0, -179.0, -75.0);
  openChest(geometry);
  click("brush");
  find<QComboBox>("brushLung").setCurrentText("Right");
  find<QDoubleSpinBox>("brushRadius").setValue(20.0);
  SliceView& axial = view("slice_axial");
  const QPoint start = axial.rect().center();
  QTest::mousePress(&axial, Qt::LeftButton, {}, start);
  constexpr int Moves = 12;
  QElapsedTimer clock;
  clock.start();
  for (int i = 1; i <= Moves; ++i) {
    move(axial, start + QPoint(6 * i, 2 * i), Qt::LeftButton);
    QApplication::processEvents();
  }
  const double eachMs = static_cast<double>(clock.elapsed()) / Moves;
  QTest::mouseRelease(&axial, Qt::LeftButton, {}, start);
  RecordProperty("move_ms", std::to_string(eachMs));
  EXPECT_LT(eachMs, 50.0 * machineLoad());
  ASSERT_TRUE(idle());
}

}  // namespace
}  // namespace pneuma
