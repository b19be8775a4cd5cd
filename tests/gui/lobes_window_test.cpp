#include <QAction>
#include <QApplication>
#include <QMouseEvent>
#include <QSlider>
#include <set>

#include <gtest/gtest.h>

#include "io/surface_file.h"
#include "io/volume_file.h"
#include "render/generated_chest.h"
#include "render/generated_lungs.h"
#include "widgets/slice_view.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

/// The step "Lobes" of the window, with a CT or with surfaces of whole lungs.
class LobesWindowTest : public testing::WindowTest {
 protected:
  void openCt() {
    writeVolume(inFolder("ct.nii.gz"), test::generatedChest(test::chestGrid()).ct);
    window.open({inFolder("ct.nii.gz")});
    ASSERT_TRUE(idle());
    click("stepLobes");
    QTest::qWait(50);
  }

  void openSurfaces() {
    const Vec3 radii(55.0, 80.0, 115.0);
    writeSurface(inFolder("right.stl"), test::ellipsoid(Vec3(-75.0, 0.0, 0.0), radii));
    writeSurface(inFolder("left.stl"), test::ellipsoid(Vec3(75.0, 0.0, 0.0), radii));
    window.open({std::filesystem::path(folder.path().toStdString())});
    ASSERT_TRUE(idle());
    QTest::qWait(300);
  }

  SliceView& sagittal() { return find<SliceView>("slice_sagittal"); }

  void clickAt(const Vec3& point) {
    QTest::mouseClick(&sagittal(), Qt::LeftButton, {}, sagittal().positionOf(point));
  }

  void drag(QWidget& target, const QPoint& from, const QPoint& to) {
    QTest::mousePress(&target, Qt::LeftButton, {}, from);
    QMouseEvent move(QEvent::MouseMove, to, target.mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                     Qt::NoModifier);
    QApplication::sendEvent(&target, &move);
    QTest::mouseRelease(&target, Qt::LeftButton, {}, to);
  }

  std::size_t points(Fissure fissure) { return window.fissures().edit(fissure).points.size(); }

  QString line(const char* fissure) {
    return find<QLabel>((std::string("fissureState_") + fissure).c_str()).text();
  }
};

TEST_F(LobesWindowTest, TheProposalIsDrawnOverTheSlicesAtOnce) {
  openCt();
  EXPECT_EQ(line("right-horizontal"), "Proposed by the lung's shape");
  SliceView& coronal = find<SliceView>("slice_coronal");
  const QImage with = coronal.picture();
  click("stepLungs");
  EXPECT_NE(coronal.picture(), with);
  EXPECT_FALSE(find<QAction>("actionPlacePoints").isEnabled());
}

TEST_F(LobesWindowTest, ClicksSetPointsWhileTheyAreWantedAndMoveTheCrosshairElse) {
  openCt();
  click("edit_right-oblique");
  window.slices().moveTo(Vec3(-72.0, 0.0, 0.0));
  clickAt(Vec3(-72.0, 20.0, 10.0));
  EXPECT_EQ(points(Fissure::RightOblique), 0U);
  EXPECT_NEAR(window.slices().point().y(), 20.0, 3.1);
  sagittal().setFocus();
  QTest::keyClick(&sagittal(), Qt::Key_P);
  EXPECT_TRUE(find<QAbstractButton>("placePoints").isChecked());
  clickAt(Vec3(-72.0, -40.0, -40.0));
  clickAt(Vec3(-72.0, 0.0, 0.0));
  clickAt(Vec3(-72.0, 40.0, 30.0));
  ASSERT_EQ(points(Fissure::RightOblique), 3U);
  const Vec3 second = window.fissures().edit(Fissure::RightOblique).points[1];
  EXPECT_LT((second - Vec3(window.slices().point().x(), 0.0, 0.0)).norm(), 2.5);
  EXPECT_NEAR(window.slices().point().y(), 20.0, 3.1);
  QTest::keyClick(&sagittal(), Qt::Key_Backspace);
  EXPECT_EQ(points(Fissure::RightOblique), 2U);
  QTest::keyClick(&sagittal(), Qt::Key_Tab);
  EXPECT_EQ(window.fissures().current(), Fissure::RightHorizontal);
  find<QAction>("actionCancel").trigger();  // Escape leaves the tool first
  EXPECT_FALSE(window.fissures().placing());
}

TEST_F(LobesWindowTest, APointFollowsTheMouseAndTheLobesFollowIt) {
  openCt();
  click("edit_right-oblique");
  window.slices().moveTo(Vec3(-72.0, 0.0, 0.0));
  find<QAction>("actionPlacePoints").trigger();
  for (const double y : {-40.0, 0.0, 40.0}) clickAt(Vec3(-72.0, y, 0.5 * y));
  window.slices().moveTo(Vec3(-50.0, 0.0, 0.0));
  clickAt(Vec3(-50.0, 0.0, 0.0));
  window.slices().moveTo(Vec3(-72.0, 0.0, 0.0));
  find<QAction>("actionPlacePoints").trigger();
  const double before = window.fissures().volumesMm3().at(Lobe::RightLower);
  const QImage shown = sagittal().picture();
  const Vec3 place = window.fissures().edit(Fissure::RightOblique).points[2];
  drag(sagittal(), sagittal().positionOf(place),
       sagittal().positionOf(place + Vec3(0.0, 0.0, 30.0)));
  EXPECT_NEAR(window.fissures().edit(Fissure::RightOblique).points[2].z(), place.z() + 30.0, 2.5);
  EXPECT_GT(window.fissures().volumesMm3().at(Lobe::RightLower), before + 10000.0);
  EXPECT_NE(sagittal().picture(), shown);
  QTest::mouseClick(&sagittal(), Qt::RightButton, {},
                    sagittal().positionOf(place + Vec3(0.0, 0.0, 30.0)));
  EXPECT_EQ(points(Fissure::RightOblique), 3U);
}

TEST_F(LobesWindowTest, SplitsAndGrowsInTheFiveLobes) {
  openSurfaces();
  click("splitLobes");
  ASSERT_TRUE(idle());
  ASSERT_FALSE(find<QWidget>("errorCard").isVisible())
      << find<QLabel>("errorSentence").text().toStdString();
  EXPECT_EQ(window.document().model().surfaces->size(), 5U);
  EXPECT_TRUE(find<SheetCard>("lobeChecks").text().contains("Sum is the lung"));
  EXPECT_TRUE(find<SheetCard>("lobeVolumes").text().contains("RML"));
  find<QSlider>("smoothness").setValue(60);
  ASSERT_TRUE(idle());
  EXPECT_NEAR(window.document().snapshot().lobeEdits.options.smoothness, 0.0251, 1e-3);
  click("stepAirways");
  find<QAbstractButton>("method_centroid").click();
  grow(500);
  ASSERT_NE(window.document().model().growth, nullptr)
      << find<QLabel>("errorSentence").text().toStdString();
  std::set<Lobe> served;
  for (const Branch& branch : *window.document().tree()) served.insert(branch.lobe);
  for (const Lobe lobe : FiveLobes) EXPECT_TRUE(served.contains(lobe)) << shortName(lobe);
}

TEST_F(LobesWindowTest, SurfacesOfWholeLungsGoStraightToTheLobes) {
  openSurfaces();
  EXPECT_TRUE(find<QAbstractButton>("stepLobes").isChecked());
  EXPECT_FALSE(find<QWidget>("stepLungs").isVisible());
  EXPECT_TRUE(line("left-oblique").contains("Proposed"));
}

TEST_F(LobesWindowTest, WithoutACtClicksOnTheLungSetPoints) {
  openSurfaces();
  click("edit_right-oblique");
  find<QAction>("actionPlacePoints").trigger();
  const Vec3 front(-75.0, -80.0, 0.0);  // the nearest point of the lung to who looks from before
  QTest::keyClick(window.view().canvas(), Qt::Key_A);
  QTest::qWait(300);
  QTest::mouseClick(window.view().canvas(), Qt::LeftButton, {}, window.view().positionOf(front));
  ASSERT_EQ(points(Fissure::RightOblique), 1U);
  EXPECT_LT((window.fissures().edit(Fissure::RightOblique).points[0] - front).norm(), 4.0);
}

TEST_F(LobesWindowTest, HandlesOfAPlaneFollowTheMouseInTheSceneAndTheCameraStays) {
  openSurfaces();
  click("plane_left-oblique");
  QTest::keyClick(window.view().canvas(), Qt::Key_L);
  QTest::qWait(300);
  const std::vector<FissureEditor::Mark> marks = window.fissures().marks();
  ASSERT_EQ(marks.size(), 3U);
  const double before = window.fissures().volumesMm3().at(Lobe::LeftLower);
  const QPoint from = window.view().positionOf(marks[0].place);
  const QPoint still = window.view().positionOf(Vec3(0.0, 0.0, 100.0));
  drag(*window.view().canvas(), from, from - QPoint(0, 40));
  EXPECT_GT(window.fissures().marks()[0].place.z(), marks[0].place.z() + 5.0);
  EXPECT_NE(window.fissures().volumesMm3().at(Lobe::LeftLower), before);
  EXPECT_EQ(window.view().positionOf(Vec3(0.0, 0.0, 100.0)), still);
  EXPECT_EQ(window.document().undoName(), "turn a plane");
}

}  // namespace
}  // namespace pneuma
