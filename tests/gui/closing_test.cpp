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
  EXPECT_TRUE(QTest::qWaitFor([this] { return !window.isVisible(); }));
  EXPECT_EQ(treeOf(readProject(inFolder("kept.pneuma")).state.model)->size(), branches());
}

TEST_F(ClosingTest, ASaveThatFailsKeepsTheWindow) {
  EXPECT_FALSE(window.close());
  click("closeSave");
  settle();
  auto& dialog = find<QFileDialog>("saveDialog");
  emit dialog.fileSelected(QString::fromStdString(inFolder("no such folder/case.pneuma").string()));
  dialog.close();
  ASSERT_TRUE(idle());
  EXPECT_TRUE(find<QWidget>("errorCard").isVisible());
  EXPECT_TRUE(window.isVisible());
  // Nor does the next save close it.
  window.document().saveProject(inFolder("case.pneuma"), CtStorage::Linked, {}, {});
  ASSERT_TRUE(idle());
  EXPECT_TRUE(window.isVisible());
}

TEST_F(ClosingTest, DoesNotAskWhenNothingWouldBeLost) {
  window.document().saveTree(inFolder("tree.vtp"));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(window.close());
  EXPECT_FALSE(asked());
}

TEST_F(ClosingTest, AsksBeforeItStopsAJob) {
  window.document().saveTree(inFolder("tree.vtp"));
  ASSERT_TRUE(idle());
  setTerminals(200000);
  find<QAbstractButton>("grow").click();
  EXPECT_FALSE(window.close());
  ASSERT_TRUE(asked());
  click("stopJob");
  EXPECT_TRUE(QTest::qWaitFor([this] { return !window.isVisible(); }, 60000));
}

TEST_F(ClosingTest, AProjectThatIsOpenedAsksFirst) {
  window.document().saveProject(inFolder("case.pneuma"), CtStorage::Linked, {}, {});
  ASSERT_TRUE(idle());
  EXPECT_FALSE(window.document().modified());
  EXPECT_TRUE(window.windowTitle().startsWith("case.pneuma"));
  const std::size_t before = branches();
  grow(300);
  EXPECT_TRUE(window.isWindowModified());
  EXPECT_EQ(find<QLabel>("caseName").text(), "case.pneuma *");
  window.open({inFolder("case.pneuma")});
  ASSERT_TRUE(asked());
  click("closeDiscard");
  settle();
  ASSERT_TRUE(idle());
  EXPECT_EQ(branches(), before);
  EXPECT_FALSE(window.isWindowModified());
  EXPECT_EQ(window.document().undoName(), "grow airways");
  window.document().undo();
  EXPECT_EQ(window.document().model().growth, nullptr);
}

TEST_F(ClosingTest, AnotherCaseIsNotSavedInItsPlace) {
  window.document().saveProject(inFolder("case.pneuma"), CtStorage::Linked, {}, {});
  ASSERT_TRUE(idle());
  window.document().openOrgan("sphere");
  ASSERT_TRUE(idle());
  EXPECT_TRUE(window.document().projectPath().empty());
  EXPECT_FALSE(window.document().workUnsaved());
}

}  // namespace
}  // namespace pneuma
