#include "widgets/breath_chart.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <limits>

#include "document/breath_player.h"
#include "document/text.h"
#include "widgets/theme.h"

namespace pneuma {

namespace {

constexpr int Samples = 240;
constexpr int Margin = 40;
constexpr int Foot = 34;
constexpr int PlotGap = 12;
constexpr double MlPerLitre = 1000.0;

/// The distance of ticks so that there are at most five.
double tickStep(double range) {
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(range, 1e-9) / 4.0)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (range / (digit * decade) <= 5.0) return digit * decade;
  }
  return 10.0 * decade;
}

}  // namespace

BreathChart::BreathChart(BreathPlayer& player, QWidget* parent) : QWidget(parent), player_(player) {
  setMinimumHeight(260);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
  setAccessibleName(tr("Volume over time, and over pressure"));
  connect(&player_, &BreathPlayer::moved, this, QOverload<>::of(&QWidget::update));
  connect(&player_, &BreathPlayer::changed, this, QOverload<>::of(&QWidget::update));
}

QPointF BreathChart::Plot::place(const QPointF& value) const {
  const double x = (value.x() - low[0]) / std::max(1e-9, high[0] - low[0]);
  const double y = (value.y() - low[1]) / std::max(1e-9, high[1] - low[1]);
  return {box.left() + x * box.width(), box.bottom() - y * box.height()};
}

BreathChart::Plot BreathChart::overTime() const {
  const BreathingLungs& lungs = player_.breath()->lungs;
  Plot plot;
  plot.box = QRectF(Margin, 8, width() - Margin - 10, (height() - 2 * Foot - PlotGap - 8) / 2.0);
  plot.across = tr("s");
  plot.up = tr("mL above rest");
  plot.at = [&lungs](double phase) {
    return QPointF(phase * lungs.drive.period, MlPerLitre * lungs.cycle.at(phase).volume);
  };
  return plot;
}

BreathChart::Plot BreathChart::loop() const {
  const BreathingLungs& lungs = player_.breath()->lungs;
  Plot plot = overTime();
  plot.box.moveTop(plot.box.bottom() + Foot + PlotGap);
  plot.across = tr("cmH2O of the muscles");
  plot.at = [&lungs](double phase) {
    const BreathSample sample = lungs.cycle.at(phase);
    return QPointF(sample.pressure, MlPerLitre * sample.volume);
  };
  return plot;
}

void BreathChart::paint(QPainter& painter, const Plot& given) const {
  const Theme& theme = currentTheme();
  Plot plot = given;
  for (double& low : plot.low) low = std::numeric_limits<double>::max();
  for (double& high : plot.high) high = std::numeric_limits<double>::lowest();
  for (int i = 0; i < Samples; ++i) {
    const QPointF value = plot.at(static_cast<double>(i) / Samples);
    plot.low[0] = std::min({plot.low[0], value.x(), 0.0});
    plot.high[0] = std::max(plot.high[0], value.x());
    plot.low[1] = std::min({plot.low[1], value.y(), 0.0});
    plot.high[1] = std::max(plot.high[1], value.y());
  }
  plot.high[1] += 0.04 * (plot.high[1] - plot.low[1]);
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  for (int axis = 0; axis < 2; ++axis) {
    const double step = tickStep(plot.high[axis] - plot.low[axis]);
    for (double tick = std::ceil(plot.low[axis] / step - 1e-9) * step;
         tick <= plot.high[axis] + 1e-9; tick += step) {
      const QString text = QString::number(std::abs(tick) < 1e-9 ? 0.0 : tick);
      painter.setPen(QPen(theme.line, 1.0));
      if (axis == 0) {
        const double x = plot.place({tick, 0.0}).x();
        painter.drawLine(QPointF(x, plot.box.bottom()), QPointF(x, plot.box.bottom() + 4));
        painter.setPen(theme.dim);
        painter.drawText(QRectF(x - 20, plot.box.bottom() + 4, 40, 14), Qt::AlignCenter, text);
      } else {
        const double y = plot.place({0.0, tick}).y();
        painter.drawLine(QPointF(plot.box.left(), y), QPointF(plot.box.right(), y));
        painter.setPen(theme.dim);
        painter.drawText(QRectF(0, y - 9, plot.box.left() - 6, 18),
                         Qt::AlignRight | Qt::AlignVCenter, text);
      }
    }
  }
  painter.setPen(theme.dim);
  painter.drawText(QRectF(plot.box.left(), plot.box.bottom() + 17, plot.box.width(), 15),
                   Qt::AlignCenter, QStringLiteral("%1  /  %2").arg(plot.across, plot.up));
  QPainterPath line(plot.place(plot.at(0.0)));
  for (int i = 1; i <= Samples; ++i) {
    line.lineTo(plot.place(plot.at(std::min(1.0 - 1e-9, static_cast<double>(i) / Samples))));
  }
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(theme.accent, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(line);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme.text);
  painter.drawEllipse(plot.place(plot.at(player_.phase())), 4.5, 4.5);
}

void BreathChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!player_.breath()) {
    painter.setPen(currentTheme().dim);
    painter.drawText(rect(), Qt::AlignCenter, tr("Nothing breathes yet"));
    return;
  }
  paint(painter, overTime());
  paint(painter, loop());
}

void BreathChart::goTo(const QPoint& position) {
  if (!player_.breath()) return;
  const QRectF box = overTime().box;
  if (position.y() > box.bottom() + Foot) return;
  const double share = (position.x() - box.left()) / std::max(1.0, box.width());
  player_.setPlaying(false);
  player_.setPhase(std::clamp(share, 0.0, 1.0 - 1e-6));
}

void BreathChart::mousePressEvent(QMouseEvent* event) { goTo(event->pos()); }

void BreathChart::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) goTo(event->pos());
}

}  // namespace pneuma
