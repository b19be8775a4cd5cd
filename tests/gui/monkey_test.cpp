#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QKeySequence>
#include <QMenu>
#include <QSlider>
#include <QTimer>
#include <QWheelEvent>
#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "core/random.h"
#include "widgets/slice_view.h"
#include "window_fixture.h"

// Somebody who does anything at all to the window.
namespace pneuma {
namespace {

std::atomic<int> complaints = 0;
std::string lastComplaint;

void countComplaints(QtMsgType type, const QMessageLogContext&, const QString& text) {
  if (type == QtDebugMsg || type == QtInfoMsg) return;
  ++complaints;
  lastComplaint = text.toStdString();
}

/// How many actions; PNEUMA_MONKEY_ACTIONS asks for more than a quick run has.
int actionCount() {
  const char* wanted = std::getenv("PNEUMA_MONKEY_ACTIONS");
  return wanted == nullptr ? 150 : std::atoi(wanted);
}

/// Another seed does other things: PNEUMA_MONKEY_SEED.
std::uint64_t seed() {
  const char* wanted = std::getenv("PNEUMA_MONKEY_SEED");
  return wanted == nullptr ? 2026 : std::strtoull(wanted, nullptr, 10);
}

class MonkeyTest : public testing::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    // Whatever it saves by a name it made up, it saves here.
    before_ = QDir::currentPath();
    QDir::setCurrent(folder.path());
    openChestFromFiles();
    // A menu that a button opened would wait for an answer for ever.
    QObject::connect(&closer_, &QTimer::timeout, [] {
      if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
    });
    closer_.start(100);
    complaints = 0;
    handler_ = qInstallMessageHandler(countComplaints);
  }

  void TearDown() override {
    qInstallMessageHandler(handler_);
    QDir::setCurrent(before_);
  }

  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_.below(count)); }

  /// One of the widgets of a kind that can be used now, or null.
  template <class Widget>
  Widget* any() {
    QList<Widget*> found;
    for (QWidget* top : QApplication::topLevelWidgets()) {
      if (!top->isVisible()) continue;
      for (Widget* widget : top->findChildren<Widget*>()) {
        const bool again = found.contains(widget);
        if (!again && widget->isVisible() && widget->isEnabled()) found.append(widget);
      }
    }
    return found.isEmpty() ? nullptr : found[static_cast<int>(below(found.size()))];
  }

  void triggerAction() {
    QList<QAction*> found;
    for (QAction* action : window.findChildren<QAction*>()) {
      if (action->isEnabled() && !action->objectName().isEmpty() && action->menu() == nullptr &&
          action->objectName() != QLatin1String("actionQuit")) {
        found.append(action);
      }
    }
    if (found.isEmpty()) return;
    QAction* action = found[static_cast<int>(below(found.size()))];
    note(action->objectName());
    action->trigger();
  }

  void clickButton() {
    auto* button = any<QAbstractButton>();
    if (button == nullptr) return;
    note(button->objectName());
    QTest::mouseClick(button, Qt::LeftButton);
  }

  void setNumber() {
    auto* box = any<QDoubleSpinBox>();
    if (box == nullptr) return;
    const double share = random_.uniform();
    const double value = box->minimum() + share * share * share * (box->maximum() - box->minimum());
    note(box->objectName() + QStringLiteral(" = ") + QString::number(value));
    box->setValue(value);
  }

  void choose() {
    auto* box = any<QComboBox>();
    if (box == nullptr || box->count() == 0) return;
    const auto at = static_cast<int>(below(static_cast<std::size_t>(box->count())));
    note(box->objectName() + QStringLiteral(" = ") + box->itemText(at));
    box->setCurrentIndex(at);
    emit box->activated(at);
  }

  void slide() {
    auto* slider = any<QSlider>();
    if (slider == nullptr) return;
    note(slider->objectName());
    slider->setValue(slider->minimum() + static_cast<int>(below(static_cast<std::size_t>(
                                             slider->maximum() - slider->minimum() + 1))));
  }

  QWidget* anyView() {
    QList<QWidget*> views = {window.view().canvas()};
    for (SliceView* slice : window.findChildren<SliceView*>()) {
      if (slice->isVisible()) views.append(slice);
    }
    return views[static_cast<int>(below(static_cast<std::size_t>(views.size())))];
  }

  QPoint anyPoint(const QWidget& widget) {
    return {static_cast<int>(random_.uniform() * widget.width()),
            static_cast<int>(random_.uniform() * widget.height())};
  }

  void useView() {
    QWidget* view = anyView();
    note(QStringLiteral("view ") + view->objectName());
    const QPoint from = anyPoint(*view);
    const Qt::MouseButton button =
        std::array{Qt::LeftButton, Qt::LeftButton, Qt::MiddleButton, Qt::RightButton}[below(4)];
    switch (below(4)) {
      case 0:
        QTest::mouseClick(view, button, {}, from);
        break;
      case 1:
        QTest::mouseDClick(view, Qt::LeftButton, {}, from);
        break;
      case 2:
        QTest::mousePress(view, button, {}, from);
        for (int i = 0; i < 3; ++i) QTest::mouseMove(view, anyPoint(*view));
        QTest::mouseRelease(view, button, {}, anyPoint(*view));
        break;
      default: {
        const int steps = below(2) == 0 ? 120 : -120;
        QWheelEvent wheel(from, view->mapToGlobal(from), {}, {0, steps}, Qt::NoButton, {},
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(view, &wheel);
      }
    }
  }

  void pressKey() {
    static constexpr std::array Keys = {
        Qt::Key_Escape, Qt::Key_Return, Qt::Key_Space, Qt::Key_Tab,  Qt::Key_Delete,
        Qt::Key_Up,     Qt::Key_Down,   Qt::Key_A,     Qt::Key_P,    Qt::Key_V,
        Qt::Key_G,      Qt::Key_R,      Qt::Key_1,     Qt::Key_3,    Qt::Key_5,
        Qt::Key_Comma,  Qt::Key_Period, Qt::Key_F5,    Qt::Key_Home, Qt::Key_Question};
    QWidget* focus = QApplication::focusWidget();
    const Qt::Key key = Keys[below(Keys.size())];
    note(QStringLiteral("key ") + QKeySequence(key).toString());
    QTest::keyClick(focus != nullptr ? focus : &window, key);
  }

  void resize() {
    static constexpr std::array Sizes = {QSize(1366, 768), QSize(1600, 1000), QSize(1366, 1000)};
    const QSize size = Sizes[below(Sizes.size())];
    note(QStringLiteral("size"));
    window.resize(size);
  }

  void act() {
    const std::size_t dice = below(100);
    if (dice < 30) return clickButton();
    if (dice < 50) return triggerAction();
    if (dice < 62) return setNumber();
    if (dice < 70) return choose();
    if (dice < 76) return slide();
    if (dice < 90) return useView();
    if (dice < 98) return pressKey();
    resize();
  }

  /// What lies over the window goes again: in the end nobody could do anything but answer it.
  void closeWhatIsOver() {
    for (QDialog* dialog : window.findChildren<QDialog*>()) {
      if (dialog->isVisible() && below(3) == 0) dialog->reject();
    }
  }

  void note(const QString& what) {
    steps_.append(what);
    if (std::getenv("PNEUMA_MONKEY_TALKS") != nullptr) {
      std::fprintf(stderr, "%d %s\n", static_cast<int>(steps_.size()), qPrintable(what));
    }
  }

  /// The last steps, for whoever has to find out.
  std::string trail() const {
    return steps_.mid(std::max(0, steps_.size() - 15)).join(", ").toStdString();
  }

  Random random_{seed()};

 private:
  QTimer closer_;
  QString before_;
  QtMessageHandler handler_ = nullptr;
  QStringList steps_;
};

TEST_F(MonkeyTest, LeavesAWindowThatWorks) {
  constexpr int StopMilliseconds = 10000;  // generous: other tests hold a stop to half a second
  for (int i = 0; i < actionCount(); ++i) {
    act();
    QTest::qWait(5);
    closeWhatIsOver();
    ASSERT_TRUE(window.isVisible()) << trail();
    ASSERT_EQ(complaints, 0) << lastComplaint << " after " << trail();
    if (below(12) == 0 && !idle(2000)) window.document().jobs().cancel();
  }
  for (QDialog* dialog : window.findChildren<QDialog*>()) dialog->reject();
  window.document().jobs().cancel();
  ASSERT_TRUE(idle(StopMilliseconds)) << trail();
  // It still does what it is for.
  Document& document = window.document();
  document.open({std::filesystem::path(folder.path().toStdString()) / "RUL.stl"});
  ASSERT_TRUE(idle());
  KitaokaOptions options;
  options.terminals = 200;
  document.setGrowthOptions(options);
  document.grow();
  ASSERT_TRUE(idle());
  EXPECT_GT(branches(), 300U) << trail();
}

}  // namespace
}  // namespace pneuma
