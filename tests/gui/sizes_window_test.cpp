// Small windows and small displays: nothing is cut, nothing lies over anything else.
#include <QAction>
#include <QScrollArea>
#include <QStackedWidget>

#include <gtest/gtest.h>

#include "io/volume_file.h"
#include "render/generated_chest.h"
#include "widgets/step_button.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

class SizesWindowTest : public testing::WindowTest {
 protected:
  void openSmallCt() {
    writeVolume(inFolder("ct.nii.gz"), test::generatedChest(test::chestGrid()).ct);
    window.open({inFolder("ct.nii.gz")});
    ASSERT_TRUE(idle());
  }

  void resizeTo(int width, int height) {
    window.resize(width, height);
    QTest::qWait(100);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);  // frames may come first
    ASSERT_EQ(window.size(), QSize(width, height));
  }

  /// What stands in a bar has the room it needs, within the bar and beside one another.
  void expectWhole(const char* name) {
    const QWidget& bar = find<QWidget>(name);
    if (!bar.isVisible()) return;
    std::vector<const QWidget*> parts;
    for (const QObject* child : bar.children()) {
      const auto* part = qobject_cast<const QWidget*>(child);
      if (part != nullptr && part->isVisible() && part->width() > 0) parts.push_back(part);
    }
    for (const QWidget* part : parts) {
      const std::string what = std::string(name) + "/" + part->metaObject()->className() + " " +
                               part->objectName().toStdString() + " at " +
                               std::to_string(window.width());
      EXPECT_GE(part->width(), part->minimumSizeHint().width()) << what;
      EXPECT_TRUE(bar.rect().contains(part->geometry())) << what;
      for (const QWidget* other : parts) {
        const bool apart = part == other || !part->geometry().intersects(other->geometry());
        EXPECT_TRUE(apart) << what;
      }
    }
  }

  /// Panels scroll upright only, and are not squeezed.
  void expectPanelsWithin() {
    const auto& rail = find<QWidget>("rail");
    const QWidget* panel = rail.findChild<QStackedWidget*>()->currentWidget();
    EXPECT_GE(panel->height(), panel->minimumSizeHint().height())
        << panel->metaObject()->className() << " at " << window.height();
    for (const QScrollArea* area : window.findChildren<QScrollArea*>()) {
      if (!area->isVisible()) continue;
      EXPECT_LE(area->widget()->width(), area->viewport()->width())
          << area->widget()->metaObject()->className() << " in " << area->objectName().toStdString()
          << " at " << window.width() << " x " << window.height();
      EXPECT_GE(area->widget()->height(), area->widget()->minimumSizeHint().height())
          << area->widget()->metaObject()->className() << " at " << window.height();
    }
  }
};

TEST_F(SizesWindowTest, NothingIsCutInSmallWindows) {
  openSmallCt();
  for (const QSize& size : {QSize(900, 600), QSize(800, 500), QSize(1366, 768), QSize(1100, 640)}) {
    resizeTo(size.width(), size.height());
    for (const char* step :
         {"stepOpen", "stepLungs", "stepLobes", "stepAirways", "stepBreathing", "stepExport"}) {
      click(step);
      QTest::qWait(50);
      for (const char* bar : {"header", "viewBar", "sliceBar", "breathBar", "rail"}) {
        expectWhole(bar);
      }
      expectPanelsWithin();
    }
  }
}

TEST_F(SizesWindowTest, TheBreathsBarIsWholeToo) {
  openChestFromFiles();
  click("stepBreathing");
  click("breathe");
  ASSERT_TRUE(idle());
  for (const int width : {1366, 1000, 900, 800}) {
    resizeTo(width, 600);
    expectWhole("breathBar");
    expectWhole("viewBar");
  }
}

TEST_F(SizesWindowTest, TheRightColumnGivesWayAndComesBack) {
  openSmallCt();
  const QWidget& column = find<QWidget>("rightColumn");
  EXPECT_TRUE(column.isVisible());
  resizeTo(900, 600);
  EXPECT_FALSE(column.isVisible());
  find<QAction>("actionRightColumn").trigger();
  EXPECT_TRUE(column.isVisible());
  resizeTo(880, 600);
  EXPECT_TRUE(column.isVisible()) << "whoever wants it has it";
  for (const char* bar : {"viewBar", "sliceBar"}) expectWhole(bar);
  find<QAction>("actionRightColumn").trigger();
  resizeTo(1366, 768);
  EXPECT_TRUE(column.isVisible());
  find<QAction>("actionRightColumn").trigger();
  resizeTo(1300, 768);
  EXPECT_FALSE(column.isVisible());
}

TEST(StepButton, TellsAllOfItsStateInTheToolTip) {
  StepButton step(1, "Open");
  step.setState(StepState::CheckMe, "490 × 512 × 131");
  EXPECT_TRUE(step.toolTip().contains("Check me: 490 × 512 × 131")) << step.toolTip().toStdString();
  step.setNumber(3);
  EXPECT_TRUE(step.toolTip().startsWith("Step 3 (key 3): Check me"));
}

}  // namespace
}  // namespace pneuma
