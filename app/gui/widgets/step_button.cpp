#include "widgets/step_button.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "widgets/theme.h"

namespace pneuma {

namespace {

QString wordFor(StepState state) {
  switch (state) {
    case StepState::ToDo:
      return StepButton::tr("To do");
    case StepState::Running:
      return StepButton::tr("Running");
    case StepState::CheckMe:
      return StepButton::tr("Check me");
    case StepState::Done:
      return StepButton::tr("Done");
    case StepState::OutOfDate:
      return StepButton::tr("Out of date");
  }
  return {};
}

}  // namespace

StepButton::StepButton(int number, const QString& title, QWidget* parent)
    : QAbstractButton(parent), number_(number) {
  setText(title);
  setCheckable(true);
  setAutoExclusive(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_Hover);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setNumber(number);
  describe();
}

void StepButton::setNumber(int number) {
  number_ = number;
  describe();
}

void StepButton::setState(StepState state, const QString& note) {
  // Asked for with every progress, and a repaint also composes the 3-D view again.
  if (state == state_ && note == note_) return;
  state_ = state;
  note_ = note;
  describe();
}

void StepButton::describe() {
  const QString word = wordFor(state_);
  // "Done" needs no word where there is a figure to show; every other state says itself.
  if (note_.isEmpty()) {
    line_ = word;
  } else {
    line_ = state_ == StepState::Done ? note_ : word + QStringLiteral(": ") + note_;
  }
  setToolTip(tr("Step %1 (key %1): %2").arg(QString::number(number_), line_));
  setAccessibleName(QStringLiteral("%1, %2").arg(text(), line_));
  setAccessibleDescription(word);
  update();
}

void StepButton::setCompact(bool compact) {
  if (compact == compact_) return;
  compact_ = compact;
  updateGeometry();
  update();
}

QString StepButton::lineWithin(int width, const QFontMetrics& metrics) const {
  // Half a figure misleads; the tool tip has the whole of it.
  const bool fits = metrics.horizontalAdvance(line_) <= width;
  if (fits || state_ == StepState::Done) return metrics.elidedText(line_, Qt::ElideRight, width);
  return metrics.elidedText(wordFor(state_), Qt::ElideRight, width);
}

QSize StepButton::sizeHint() const { return {224, compact_ ? 32 : 50}; }

void StepButton::paintState(QPainter& painter, const QRectF& box) const {
  const Theme& theme = currentTheme();
  const QPointF c = box.center();
  switch (state_) {
    case StepState::ToDo:
      painter.setPen(QPen(theme.dim, 1.6));
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(c, 7.5, 7.5);
      break;
    case StepState::Running:
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(theme.line, 2.2));
      painter.drawEllipse(c, 7.5, 7.5);
      painter.setPen(QPen(theme.accent, 2.2, Qt::SolidLine, Qt::RoundCap));
      painter.drawArc(QRectF(c.x() - 7.5, c.y() - 7.5, 15, 15), 90 * 16, -200 * 16);
      break;
    case StepState::Done: {
      painter.setPen(Qt::NoPen);
      painter.setBrush(theme.good);
      painter.drawEllipse(c, 8.5, 8.5);
      QPainterPath tick(c + QPointF(-3.6, 0.2));
      tick.lineTo(c + QPointF(-1.0, 2.9));
      tick.lineTo(c + QPointF(3.8, -2.6));
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(theme.panel, 1.9, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.drawPath(tick);
      break;
    }
    case StepState::CheckMe:
    case StepState::OutOfDate:
      painter.setPen(state_ == StepState::CheckMe ? QPen(Qt::NoPen) : QPen(theme.look, 1.8));
      painter.setBrush(state_ == StepState::CheckMe ? QBrush(theme.look) : QBrush(Qt::NoBrush));
      painter.drawEllipse(c, 8.0, 8.0);
      painter.setPen(QPen(state_ == StepState::CheckMe ? theme.panel : theme.look, 2.0,
                          Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(c + QPointF(0, -4), c + QPointF(0, 1));
      painter.drawPoint(c + QPointF(0, 4.2));
      break;
  }
}

void StepButton::paintEvent(QPaintEvent*) {
  const Theme& theme = currentTheme();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF row = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  painter.setPen(hasFocus() ? QPen(theme.accent, 1.0) : QPen(Qt::NoPen));
  painter.setBrush(isChecked()    ? QBrush(theme.selection)
                   : underMouse() ? QBrush(theme.card)
                                  : QBrush(Qt::NoBrush));
  painter.drawRoundedRect(row, 8, 8);
  paintState(painter, QRectF(10, 0, 22, height()));

  const int half = height() / 2;
  QRect upper(44, 7, width() - 44 - 34, half - 7);
  QRect lower(44, half, width() - 44 - 26, half - 6);
  QFont bold = font();
  bold.setWeight(QFont::DemiBold);
  if (compact_) {
    const int from = std::max(108, 44 + QFontMetrics(bold).horizontalAdvance(text()) + 8);
    upper = QRect(44, 0, from - 44, height());
    lower = QRect(from, 0, width() - from - 26, height());
  }
  painter.setFont(bold);
  painter.setPen(theme.text);
  painter.drawText(upper, Qt::AlignLeft | Qt::AlignVCenter, text());
  QFont small = font();
  small.setPixelSize(12);
  painter.setFont(small);
  painter.setPen(theme.dim);
  painter.drawText(lower, Qt::AlignLeft | Qt::AlignVCenter,
                   lineWithin(lower.width(), QFontMetrics(small)));
  painter.setFont(font());
  painter.drawText(QRect(width() - 34, 0, 22, height()), Qt::AlignRight | Qt::AlignVCenter,
                   QString::number(number_));
}

}  // namespace pneuma
