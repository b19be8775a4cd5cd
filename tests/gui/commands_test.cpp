#include "widgets/commands.h"

#include <QAction>
#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <algorithm>
#include <set>

#include "widgets/keys_overlay.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

using testing::WindowTest;

/// The palette and the overview of keys.
class CommandsTest : public WindowTest {
 protected:
  QMenuBar& menus() { return find<QMenuBar>("menus"); }

  QListWidget& list() { return find<QListWidget>("paletteList"); }

  QLineEdit& typing() { return find<QLineEdit>("paletteSearch"); }

  KeysOverlay& keys() { return find<KeysOverlay>("keysOverlay"); }

  QString firstTitle() { return list().count() == 0 ? QString() : list().item(0)->text(); }

  /// As from the keyboard: through the field's filter, not past it.
  void press(Qt::Key key) { QTest::keyClick(&typing(), key); }
};

TEST_F(CommandsTest, EveryKeyOfEveryActionIsInTheOverview) {
  const std::vector<KeyRow> rows = keyRows(menus(), MouseProfile::Usual);
  int withKeys = 0;
  for (const QAction* action : window.findChildren<QAction*>()) {
    if (!action->isVisible()) continue;
    for (const QKeySequence& key : action->shortcuts()) {
      ++withKeys;
      const QString text = key.toString(QKeySequence::NativeText);
      EXPECT_TRUE(std::ranges::any_of(rows,
                                      [&](const KeyRow& row) {
                                        return row.what == plainText(action->text()) &&
                                               row.keys.contains(text);
                                      }))
          << text.toStdString() << " of " << action->objectName().toStdString();
    }
  }
  EXPECT_GT(withKeys, 30);
}

TEST_F(CommandsTest, NoKeyMeansTwoThingsInOnePlace) {
  EXPECT_EQ(keyConflicts(keyRows(menus(), MouseProfile::Usual)).join('\n').toStdString(), "");
  // P sets points in the slices and looks from behind in the 3-D view: no conflict. It would be
  // one with a key of the whole window.
  std::vector<KeyRow> rows = keyRows(menus(), MouseProfile::Usual);
  rows.push_back({"Test", "Planted", {"P"}, KeyPlace::Window});
  EXPECT_EQ(keyConflicts(rows).size(), 2) << keyConflicts(rows).join('\n').toStdString();
  rows.back() = {"Test", "Planted", {"O"}, KeyPlace::Scene};
  EXPECT_EQ(keyConflicts(rows).size(), 1);
}

TEST_F(CommandsTest, StepsHaveTheNumbersThatAreShown) {
  openChestFromFiles();
  // Lobes alone: neither lungs nor lobes are to be found, so airways are the second step.
  QTest::keyClick(&window, Qt::Key_2);
  EXPECT_TRUE(find<QAbstractButton>("stepAirways").isChecked());
  const std::vector<KeyRow> rows = keyRows(menus(), MouseProfile::Usual);
  EXPECT_TRUE(std::ranges::any_of(rows, [](const KeyRow& row) {
    return row.what == "Step: Airways" && row.keys == QStringList{"2"};
  }));
  EXPECT_FALSE(
      std::ranges::any_of(rows, [](const KeyRow& row) { return row.what == "Step: Lungs"; }));
}

TEST_F(CommandsTest, TheOverviewOpensByItsKeyAndIsNarrowedByTyping) {
  QTest::keyClick(&window, Qt::Key_Question);  // whatever keys it takes to type it
  ASSERT_TRUE(keys().isVisible());
  EXPECT_TRUE(keys().text().contains("Edit: Grow airways: Ctrl+Return"));
  EXPECT_TRUE(keys().text().contains("In a slice: Next slice: Up, F"));
  EXPECT_TRUE(keys().text().contains("Mouse in the 3-D view: Turn: Drag"));
  auto& field = find<QLineEdit>("keysSearch");
  QTest::keyClicks(&field, "redo");
  EXPECT_EQ(keys().text().count('\n'), 1) << keys().text().toStdString();
  field.setText("ctrl+k");  // by the key itself
  EXPECT_TRUE(keys().text().startsWith("Edit: Find a command"));
  field.setText("xyzzy");
  EXPECT_TRUE(find<QWidget>("keysNothing").isVisible());
  QTest::keyClick(&field, Qt::Key_Escape);
  EXPECT_FALSE(keys().isVisible());
}

TEST_F(CommandsTest, ThePaletteRunsWhatIsFoundByKeyboardAlone) {
  openChestFromFiles();
  QTest::keyClick(&window, Qt::Key_K, Qt::ControlModifier);
  ASSERT_TRUE(typing().isVisible());
  QTest::keyClicks(&typing(), "step exp");
  EXPECT_EQ(firstTitle(), "Step: Export");
  press(Qt::Key_Return);
  EXPECT_FALSE(typing().isVisible());
  EXPECT_TRUE(find<QAbstractButton>("stepExport").isChecked());
}

TEST_F(CommandsTest, KeysOfTheWindowWaitWhileThePaletteIsOpen) {
  openChestFromFiles();
  clickBranch(0);
  ASSERT_TRUE(find<QAction>("actionCancel").isEnabled());
  QWidget* before = QApplication::focusWidget();
  find<QAction>("actionFindCommand").trigger();
  QTest::keyClicks(&typing(), "3?");
  EXPECT_EQ(typing().text(), "3?");
  EXPECT_TRUE(find<QAbstractButton>("stepAirways").isChecked());
  press(Qt::Key_Escape);
  EXPECT_FALSE(typing().isVisible());
  EXPECT_TRUE(properties().contains("Generation: 0")) << "Esc went to the window, too";
  EXPECT_EQ(QApplication::focusWidget(), before);
}

TEST_F(CommandsTest, WhatCannotBeDoneSaysWhy) {
  find<QAction>("actionFindCommand").trigger();
  typing().setText("grow airways");
  ASSERT_EQ(firstTitle(), "Grow airways");
  const QString said = list().item(0)->data(Qt::AccessibleTextRole).toString();
  EXPECT_TRUE(said.contains("Open lobe surfaces or an organ first")) << said.toStdString();
  press(Qt::Key_Return);
  EXPECT_TRUE(typing().isVisible());
  EXPECT_FALSE(window.document().jobs().busy());
  press(Qt::Key_Escape);
  // Everything that is disabled in the empty window knows why.
  for (const Command& command : commandsOf(menus())) {
    EXPECT_TRUE(command.enabled || !command.obstacle.isEmpty()) << command.title.toStdString();
  }
}

TEST_F(CommandsTest, StructuresAreHiddenShownAndCentred) {
  openChestFromFiles();
  const QImage all = window.view().picture();
  const auto runFirst = [this](const char* typed) {
    find<QAction>("actionFindCommand").trigger();
    typing().setText(typed);
    const QString title = firstTitle();
    press(Qt::Key_Return);
    return title;
  };
  EXPECT_EQ(runFirst("hide right upper"), "Hide: Right upper lobe");
  EXPECT_NE(window.view().picture(), all);
  EXPECT_EQ(runFirst("right upper show"), "Show: Right upper lobe");
  EXPECT_EQ(window.view().picture(), all);
  EXPECT_EQ(runFirst("centre left lower"), "Centre: Left lower lobe");
  EXPECT_NE(window.view().picture(), all);
  const auto& surfaces = *window.document().model().surfaces;
  const auto lobe = std::ranges::find(surfaces, Lobe::LeftLower, &LobeSurface::lobe);
  Vec3 low = lobe->mesh->points.front();
  Vec3 high = low;
  for (const Vec3& point : lobe->mesh->points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const QPoint at = window.view().positionOf(0.5 * (low + high));
  const QPoint middle = window.view().canvas()->rect().center();
  EXPECT_LE((at - middle).manhattanLength(), 3);
}

}  // namespace
}  // namespace pneuma
