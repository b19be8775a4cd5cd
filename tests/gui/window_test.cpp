#include <QAction>
#include <QComboBox>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QLineEdit>
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "io/tree_file.h"
#include "machine_load.h"
#include "widgets/structure_view.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

using testing::WindowTest;

TEST_F(WindowTest, GrowsInOpenedLobesAndUndoesAndRedoes) {
  openChestFromFiles();
  const std::size_t central = branches();
  ASSERT_GT(central, 0U);
  grow(3000);
  const std::size_t grown = branches();
  EXPECT_GT(grown, 5000U);
  EXPECT_TRUE(properties().contains("Terminals"));

  find<QAction>("actionUndo").trigger();
  EXPECT_EQ(branches(), central);
  find<QAction>("actionRedo").trigger();
  EXPECT_EQ(branches(), grown);
}

TEST_F(WindowTest, AClickOnABranchShowsItsNumbers) {
  openChestFromFiles();
  grow(300);
  // The trachea is the widest and nothing lies before it.
  clickBranch(0);
  EXPECT_TRUE(properties().contains("Generation: 0")) << properties().toStdString();
  EXPECT_TRUE(properties().contains("Flow share: 100.000 %")) << properties().toStdString();
  // Along the tree with the keyboard, and away with Esc.
  QTest::keyClick(window.view().canvas(), Qt::Key_Down);
  EXPECT_TRUE(properties().contains("Generation: 1")) << properties().toStdString();
  QTest::keyClick(&window, Qt::Key_Escape);
  EXPECT_TRUE(properties().contains("Terminals")) << properties().toStdString();
}

TEST_F(WindowTest, EveryColouringLooksDifferent) {
  openChestFromFiles();
  grow(1000);
  auto& colourBy = find<QComboBox>("colourBy");
  std::vector<QImage> pictures;
  for (int i = 0; i < colourBy.count(); ++i) {
    colourBy.setCurrentIndex(i);
    pictures.push_back(window.view().picture());
    for (int before = 0; before < i; ++before) {
      EXPECT_NE(pictures.back(), pictures[static_cast<std::size_t>(before)])
          << colourBy.itemText(i).toStdString();
    }
  }
}

TEST_F(WindowTest, AViewButtonTurnsTheCamera) {
  openChestFromFiles();
  click("viewL");
  QTest::qWait(50);
  EXPECT_TRUE(find<QLabel>("viewTitle").text().contains("left"));
  QTest::keyClick(window.view().canvas(), Qt::Key_P);
  QTest::qWait(50);
  EXPECT_TRUE(find<QLabel>("viewTitle").text().contains("posterior"));
}

TEST_F(WindowTest, AShutEyeHidesTheLobe) {
  openChestFromFiles();
  const QImage before = window.view().picture();
  auto& list = find<StructureView>("structures");
  const QRect row = list.visualRect(list.model()->index(2, 0));
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, QPoint(row.left() + 10, row.center().y()));
  EXPECT_NE(window.view().picture(), before);
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, QPoint(row.left() + 10, row.center().y()));
  EXPECT_EQ(window.view().picture(), before);
}

TEST_F(WindowTest, ABigGrowthIsCancelledWithinHalfASecond) {
  openChestFromFiles();
  grow(200);
  const std::size_t before = branches();
  setTerminals(5000000);
  click("grow");
  QTest::qWait(400);
  ASSERT_TRUE(window.document().jobs().busy());
  EXPECT_FALSE(find<QAction>("actionUndo").isEnabled());
  QElapsedTimer clock;
  clock.start();
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  const auto elapsedMs = static_cast<double>(clock.elapsed());  // before the load is measured
  EXPECT_LT(elapsedMs, 500.0 * machineLoad());
  EXPECT_EQ(branches(), before);
}

TEST_F(WindowTest, TheWindowAnswersWhileAJobRuns) {
  openChestFromFiles();
  grow(200);
  setTerminals(5000000);
  qint64 longest = 0;
  QElapsedTimer sinceLast;
  sinceLast.start();
  click("grow");
  for (int i = 0; i < 40 && window.document().jobs().busy(); ++i) {
    QTest::qWait(10);
    longest = std::max(longest, sinceLast.restart());
  }
  // Many seconds if the growth ran on this thread.
  EXPECT_LT(static_cast<double>(longest), 500.0 * machineLoad());
  window.document().jobs().cancel();
  ASSERT_TRUE(idle());
}

TEST_F(WindowTest, SavesTheTreeThroughTheDialogAndItReadsBackEqual) {
  openChestFromFiles();
  grow(500);
  click("stepExport");
  click("saveTree");
  auto& dialog = find<QFileDialog>("saveDialog");
  dialog.findChild<QLineEdit*>("fileNameEdit")
      ->setText(QString::fromStdString(inFolder("saved").string()));
  QTest::keyClick(dialog.findChild<QLineEdit*>("fileNameEdit"), Qt::Key_Return);
  ASSERT_TRUE(idle());
  const AirwayTree back = readTree(inFolder("saved.vtp")).tree;
  const auto shown = window.document().tree();
  ASSERT_EQ(back.size(), shown->size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    ASSERT_EQ(back[i].parent, (*shown)[i].parent);
    ASSERT_EQ(back[i].distal, (*shown)[i].distal);
    ASSERT_EQ(back[i].radiusMm, (*shown)[i].radiusMm);
  }
}

TEST_F(WindowTest, ABadFileIsSaidInACardAndNothingChanges) {
  window.open({inFolder("missing_rul.stl")});
  ASSERT_TRUE(idle());
  EXPECT_TRUE(find<QWidget>("errorCard").isVisible());
  EXPECT_TRUE(find<QLabel>("errorSentence").text().contains("missing_rul.stl"));
  EXPECT_FALSE(find<QLabel>("errorSentence").text().contains(folder.path()));
  click("errorClose");
  EXPECT_FALSE(find<QWidget>("errorCard").isVisible());
}

TEST_F(WindowTest, WhatCannotBeDoneYetIsDisabledAndSaysWhy) {
  EXPECT_FALSE(find<QAbstractButton>("grow").isEnabled());
  EXPECT_TRUE(find<QAbstractButton>("grow").toolTip().contains("Open lobe surfaces"));
  EXPECT_FALSE(find<QAbstractButton>("saveTree").isEnabled());
}

TEST_F(WindowTest, EveryControlHasANameForScreenReadersAndScripts) {
  std::set<QString> names;
  for (const QWidget* widget : window.findChildren<QWidget*>()) {
    if (!(widget->focusPolicy() & Qt::TabFocus)) continue;
    if (widget->objectName().startsWith("qt_")) continue;
    if (qobject_cast<const QLineEdit*>(widget) != nullptr) continue;  // inside a spin box
    if (widget->inherits("QScrollArea") || widget->inherits("QComboBoxListView")) continue;
    EXPECT_FALSE(widget->objectName().isEmpty()) << widget->metaObject()->className();
    const auto* button = qobject_cast<const QAbstractButton*>(widget);
    const bool named =
        !widget->accessibleName().isEmpty() || (button != nullptr && !button->text().isEmpty());
    EXPECT_TRUE(named) << widget->objectName().toStdString();
    EXPECT_TRUE(names.insert(widget->objectName()).second) << widget->objectName().toStdString();
  }
  EXPECT_GT(names.size(), 20U);
}

}  // namespace
}  // namespace pneuma
