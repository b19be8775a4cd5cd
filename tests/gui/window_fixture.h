#pragma once

#include <QAbstractButton>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "io/surface_file.h"
#include "io/tree_file.h"
#include "pipeline/sample_chest.h"
#include "widgets/main_window.h"
#include "widgets/scene_view.h"
#include "widgets/sheet_card.h"

namespace pneuma::testing {

/// Drives the window by the names of its widgets, as a clinician would with mouse and keys.
class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    window.setTheme(ThemeName::Dark);
    window.resize(1366, 768);
    window.show();
    window.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  }

  template <class Widget>
  Widget& find(const char* name) {
    auto* found = window.findChild<Widget*>(QString::fromUtf8(name));
    if (found == nullptr) throw std::runtime_error(std::string("nothing is called ") + name);
    return *found;
  }

  void click(const char* name) { QTest::mouseClick(&find<QAbstractButton>(name), Qt::LeftButton); }

  bool idle(int milliseconds = 300000) {
    return QTest::qWaitFor([this] { return !window.document().jobs().busy(); }, milliseconds);
  }

  void setTerminals(double count) { find<QDoubleSpinBox>("option_terminals").setValue(count); }

  /// The sample chest, written as files and opened like anybody's.
  void openChestFromFiles() {
    const SampleChest chest = sampleChest(4.0);
    for (const LobeSurface& lobe : chest.lobes) {
      writeSurface(inFolder(std::string(shortName(lobe.lobe)) + ".stl"), *lobe.mesh);
    }
    writeTree(inFolder("central.vtp"), chest.central);
    window.open({std::filesystem::path(folder.path().toStdString()), inFolder("central.vtp")});
    ASSERT_TRUE(idle());
    ASSERT_FALSE(find<QWidget>("errorCard").isVisible())
        << find<QLabel>("errorSentence").text().toStdString();
  }

  void grow(double terminals) {
    click("stepAirways");
    setTerminals(terminals);
    click("grow");
    ASSERT_TRUE(idle());
    QTest::qWait(300);  // the fine picture
  }

  std::filesystem::path inFolder(const std::string& name) const {
    return std::filesystem::path(folder.path().toStdString()) / name;
  }

  std::size_t branches() {
    const auto tree = window.document().tree();
    return tree ? tree->size() : 0;
  }

  QString properties() { return find<SheetCard>("properties").text(); }

  void clickBranch(std::size_t branch) {
    const Branch& b = (*window.document().tree())[branch];
    const QPoint at = window.view().positionOf(0.5 * (b.proximal + b.distal));
    QTest::mouseClick(window.view().canvas(), Qt::LeftButton, {}, at);
  }

  QTemporaryDir folder;
  MainWindow window;
};

}  // namespace pneuma::testing
