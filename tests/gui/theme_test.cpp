#include "widgets/theme.h"

#include <QApplication>
#include <QSignalSpy>
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "widgets/mouse_picture.h"
#include "widgets/size_menu.h"

namespace pneuma {
namespace {

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

double luminance(const QColor& colour) {
  return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) +
         0.0722 * linear(colour.blueF());
}

/// Contrast ratio of WCAG 2: 1 for equal colours, 21 for black on white.
double contrast(const QColor& a, const QColor& b) {
  const auto [low, high] = std::minmax({luminance(a), luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

class ThemeTest : public ::testing::TestWithParam<ThemeName> {};

TEST_P(ThemeTest, EveryTextCanBeReadOnItsGround) {
  applyTheme(*qApp, GetParam());
  const Theme& theme = currentTheme();
  for (const QColor& ground : {theme.panel, theme.card, theme.field, theme.selection}) {
    for (const QColor& text : {theme.text, theme.dim}) {
      EXPECT_GE(contrast(text, ground), 4.5)
          << text.name().toStdString() << " on " << ground.name().toStdString();
    }
  }
  EXPECT_GE(contrast(theme.accent, theme.panel), 4.5);
  EXPECT_GE(contrast(theme.look, theme.panel), 4.5);
  EXPECT_GE(contrast(theme.onAccent, theme.accent), 4.5);
  EXPECT_GE(contrast(theme.onAccent, theme.accentHover), 4.5);
}

TEST(Size, IsTakenAtTheStartWithinWhatTheMenuOffers) {
  constexpr const char* Variable = "QT_SCALE_FACTOR";
  const QByteArray before = qgetenv(Variable);
  const auto taken = [&](int percent) {
    qunsetenv(Variable);
    takeSize(percent);
    return qgetenv(Variable).toDouble();
  };
  EXPECT_EQ(taken(150), 1.5);
  EXPECT_EQ(taken(5), 0.8);
  EXPECT_EQ(taken(900), 2.0);
  EXPECT_EQ(taken(100), 0.0) << "nothing is asked of Qt";
  qputenv(Variable, "1.25");
  takeSize(200);
  EXPECT_EQ(qgetenv(Variable), "1.25") << "the environment knows better";
  before.isEmpty() ? qunsetenv(Variable) : qputenv(Variable, before);
}

TEST(Size, MenuMarksTheNearestAndTellsWhatIsChosen) {
  SizeMenu menu(nullptr);
  QSignalSpy chosen(&menu, &SizeMenu::chosen);
  const auto marked = [&] {
    for (const QAction* size : menu.actions()) {
      if (size->isChecked()) return size->data().toInt();
    }
    return 0;
  };
  EXPECT_EQ(marked(), 100);
  menu.setPercent(160);
  EXPECT_EQ(marked(), 150);
  EXPECT_EQ(chosen.count(), 0);
  menu.actions().last()->trigger();
  ASSERT_EQ(chosen.count(), 1);
  EXPECT_EQ(chosen.at(0).at(0).toInt(), 200);
}

INSTANTIATE_TEST_SUITE_P(Both, ThemeTest, ::testing::Values(ThemeName::Dark, ThemeName::Light),
                         [](const auto& theme) {
                           return theme.param == ThemeName::Dark ? "dark" : "light";
                         });

TEST(MousePicture, NeverHasLessRoomThanItsTextTakes) {
  for (const MouseHabits& habits : mouseHabits()) {
    const MousePicture picture(habits.profile);
    constexpr int MouseWidth = 48;
    for (const SliceDrag drag : {habits.left, habits.middle, habits.right}) {
      const QString text = QObject::tr("Middle") + dragText(drag);
      EXPECT_GT(picture.minimumSizeHint().width(),
                MouseWidth + picture.fontMetrics().horizontalAdvance(text))
          << text.toStdString();
    }
  }
}

}  // namespace
}  // namespace pneuma
