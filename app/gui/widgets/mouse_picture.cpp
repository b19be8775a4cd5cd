#include "widgets/mouse_picture.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "widgets/theme.h"

namespace pneuma {

namespace {

constexpr QRectF Body(2.0, 2.0, 46.0, 70.0);
constexpr QRectF Wheel(21.0, 10.0, 8.0, 18.0);
constexpr double ButtonsEnd = 34.0;  ///< where the buttons end, from above
constexpr int TextLeft = 70;

}  // namespace

MousePicture::MousePicture(MouseProfile profile, QWidget* parent)
    : QWidget(parent), profile_(profile) {
  const MouseHabits& habits = habitsOf(profile);
  setAccessibleName(
      tr("Left drag: %1. Middle drag: %2. Right drag: %3. Wheel: next slice.")
          .arg(dragText(habits.left), dragText(habits.middle), dragText(habits.right)));
}

std::array<std::pair<QString, QString>, 4> MousePicture::lines() const {
  const MouseHabits& habits = habitsOf(profile_);
  return {{{tr("Left"), dragText(habits.left)},
           {tr("Middle"), dragText(habits.middle)},
           {tr("Right"), dragText(habits.right)},
           {tr("Wheel"), tr("Next slice")}}};
}

int MousePicture::namedWidth() const { return fontMetrics().horizontalAdvance(tr("Middle")) + 12; }

QSize MousePicture::sizeHint() const {
  int longest = 0;
  for (const auto& [button, does] : lines()) {
    longest = std::max(longest, fontMetrics().horizontalAdvance(does));
  }
  return {TextLeft + namedWidth() + longest + 2,
          std::max(static_cast<int>(Body.bottom()) + 2, 4 * fontMetrics().lineSpacing() + 4)};
}

void MousePicture::paintEvent(QPaintEvent*) {
  const Theme& theme = currentTheme();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme.dim, 1.6));
  QPainterPath body;
  body.addRoundedRect(Body, 23.0, 23.0);
  painter.drawPath(body);
  QPainterPath left;
  left.addRect(QRectF(Body.left(), Body.top(), 0.5 * Body.width(), ButtonsEnd - Body.top()));
  painter.fillPath(body.intersected(left), theme.accent);
  painter.drawLine(QPointF(Body.left(), ButtonsEnd), QPointF(Body.right(), ButtonsEnd));
  painter.drawLine(QPointF(Body.center().x(), Body.top()), QPointF(Body.center().x(), ButtonsEnd));
  painter.setBrush(theme.panel);
  painter.drawRoundedRect(Wheel, 4.0, 4.0);

  const auto told = lines();
  const int step = height() / static_cast<int>(told.size());
  const int named = namedWidth();
  int y = 0;
  for (const auto& [button, does] : told) {
    painter.setPen(button == told.front().first ? theme.accent : theme.dim);
    painter.drawText(QRect(TextLeft, y, named, step), Qt::AlignVCenter, button);
    painter.setPen(theme.text);
    painter.drawText(QRect(TextLeft + named, y, width() - TextLeft - named, step), Qt::AlignVCenter,
                     does);
    y += step;
  }
}

}  // namespace pneuma
