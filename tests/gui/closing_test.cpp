#include <QFileDialog>
#include <QLineEdit>

#include "window_fixture.h"

namespace pneuma {
namespace {

/// A window with a small grown tree that is in no file.
class ClosingTest : public testing::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    openChestFromFiles();
    grow(200);
  }

  bool asked() { return window.findChild<QWidget*>("closeQuestion") != nullptr; }

  /// Dialogs delete themselves once the event loop runs.
  static void settle() { QTest::qWait(50); }
};

TEST_F(ClosingTest, CancelKeepsTheWindow) {
  EXPECT_FALSE(window.close());
  ASSERT_TRUE(asked());
  click("closeCancel");
  settle();
  EXPECT_FALSE(asked());
  EXPECT_TRUE(window.isVisible());
}

TEST_F(ClosingTest, DiscardCloses) {
  EXPECT_FALSE(window.close());
  click("closeDiscard");
  EXPECT_FALSE(window.isVisible());
}

TEST_F(ClosingTest, AsksOnceOnly) {
  EXPECT_FALSE(window.close());
  EXPECT_FALSE(window.close());
  EXPECT_EQ(window.findChildren<QWidget*>("closeQuestion").size(), 1);
}

TEST_F(ClosingTest, SaveSavesAndThenCloses) {
  EXPECT_FALSE(window.close());
  click("closeSave");
  settle();
  auto& dialog = find<QFileDialog>("saveDialog");
  auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
  name->setText(QString::fromStdString(inFolder("kept").string()));
  QTest::keyClick(name, Qt::Key_Return);
  ASSERT_TRUE(idle());
  EXPECT_FALSE(window.isVisible());
  EXPECT_EQ(readTree(inFolder("kept.vtp")).tree.size(), branches());
}

TEST_F(ClosingTest, ASaveThatFailsKeepsTheWindow) {
  EXPECT_FALSE(window.close());
  click("closeSave");
  settle();
  auto& dialog = find<QFileDialog>("saveDialog");
  emit dialog.fileSelected(QString::fromStdString(inFolder("no such folder/tree.vtp").string()));
  dialog.close();
  ASSERT_TRUE(idle());
  EXPECT_TRUE(find<QWidget>("errorCard").isVisible());
  EXPECT_TRUE(window.isVisible());
  // Nor does the next save close it.
  window.document().saveTree(inFolder("tree.vtp"));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(window.isVisible());
}

TEST_F(ClosingTest, DoesNotAskWhenNothingWouldBeLost) {
  window.document().saveTree(inFolder("tree.vtp"));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(window.close());
  EXPECT_FALSE(asked());
}

}  // namespace
}  // namespace pneuma
