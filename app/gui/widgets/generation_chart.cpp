#include "widgets/generation_chart.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <utility>

#include "document/text.h"
#include "widgets/theme.h"

namespace pneuma {

namespace {

/// The distance of ticks so that there are at most about six.
int tickStep(int last) {
  for (const int step : {1, 2, 5, 10, 20, 50}) {
    if (last / step <= 6) return step;
  }
  return std::max(100, last / 600 * 100);
}

}  // namespace

GenerationChart::GenerationChart(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setMinimumHeight(150);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
  setAccessibleName(tr("Branches per generation"));
}

void GenerationChart::show(std::vector<std::size_t> branchesOfGeneration) {
  counts_ = std::move(branchesOfGeneration);
  pointed_.reset();
  QStringList spoken;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    spoken << QStringLiteral("%1: %2").arg(i).arg(grouped(counts_[i]));
  }
  setAccessibleDescription(spoken.join(QStringLiteral(", ")));
  update();
}

QRectF GenerationChart::plot() const { return QRectF(rect()).adjusted(40, 12, -8, -36); }

int GenerationChart::decades() const {
  const auto most =
      counts_.empty() ? std::size_t{1} : *std::max_element(counts_.begin(), counts_.end());
  return std::max(1, static_cast<int>(std::ceil(std::log10(static_cast<double>(most) + 1e-9))));
}

QPointF GenerationChart::pointOf(std::size_t generation) const {
  const QRectF box = plot();
  const double last = std::max<double>(1.0, static_cast<double>(counts_.size()) - 1.0);
  const double height = std::log10(std::max(1.0, static_cast<double>(counts_[generation])));
  return {box.left() + box.width() * static_cast<double>(generation) / last,
          box.bottom() - box.height() * height / decades()};
}

void GenerationChart::paintAxes(QPainter& painter) const {
  const Theme& theme = currentTheme();
  const QRectF box = plot();
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  for (int decade = 0; decade <= decades(); ++decade) {
    const double y = box.bottom() - box.height() * decade / decades();
    painter.setPen(QPen(theme.line, 1.0));
    painter.drawLine(QPointF(box.left(), y), QPointF(box.right(), y));
    painter.setPen(theme.dim);
    const QString text =
        decade < 3 ? QString::number(static_cast<int>(std::pow(10, decade)))
        : decade < 6
            ? QString::number(static_cast<int>(std::pow(10, decade - 3))) + QStringLiteral("k")
            : QString::number(static_cast<int>(std::pow(10, decade - 6))) + QStringLiteral("M");
    painter.drawText(QRectF(0, y - 9, box.left() - 8, 18), Qt::AlignRight | Qt::AlignVCenter, text);
  }
  const int last = std::max(1, static_cast<int>(counts_.size()) - 1);
  for (int tick = 0; tick <= last; tick += tickStep(last)) {
    const double x = box.left() + box.width() * tick / last;
    painter.setPen(QPen(theme.line, 1.0));
    painter.drawLine(QPointF(x, box.bottom()), QPointF(x, box.bottom() + 4));
    painter.setPen(theme.dim);
    painter.drawText(QRectF(x - 20, box.bottom() + 5, 40, 14), Qt::AlignCenter,
                     QString::number(tick));
  }
  painter.setPen(theme.dim);
  painter.drawText(QRectF(box.left(), box.bottom() + 20, box.width(), 15), Qt::AlignCenter,
                   tr("generation"));
}

void GenerationChart::paintPointed(QPainter& painter) const {
  if (!pointed_) return;
  const Theme& theme = currentTheme();
  const QRectF box = plot();
  const QPointF at = pointOf(*pointed_);
  painter.setPen(QPen(theme.dim, 1.0, Qt::DotLine));
  painter.drawLine(QPointF(at.x(), box.top()), QPointF(at.x(), box.bottom()));
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme.text);
  painter.drawEllipse(at, 3.5, 3.5);
  const QString text =
      tr("generation %1: %2").arg(*pointed_).arg(counted(counts_[*pointed_], "branch", "branches"));
  const QRectF space(box.left() + 4, box.bottom() - 22, box.width() - 8, 18);
  QRectF plate = QRectF(painter.fontMetrics().boundingRect(space.toRect(), Qt::AlignCenter, text))
                     .adjusted(-6, -2, 6, 2);
  painter.setBrush(theme.card);
  painter.setPen(theme.line);
  painter.drawRoundedRect(plate, 4, 4);
  painter.setPen(theme.text);
  painter.drawText(space, Qt::AlignCenter, text);
}

void GenerationChart::paintEvent(QPaintEvent*) {
  const Theme& theme = currentTheme();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (counts_.empty()) {
    painter.setPen(theme.dim);
    painter.drawText(rect(), Qt::AlignCenter, tr("No airways yet"));
    return;
  }
  paintAxes(painter);
  QPainterPath line(pointOf(0));
  for (std::size_t i = 1; i < counts_.size(); ++i) line.lineTo(pointOf(i));
  QPainterPath area = line;
  area.lineTo(plot().bottomRight());
  area.lineTo(plot().bottomLeft());
  QColor wash = theme.accent;
  wash.setAlphaF(0.16);
  painter.fillPath(area, wash);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(theme.accent, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(line);
  paintPointed(painter);
}

void GenerationChart::mouseMoveEvent(QMouseEvent* event) {
  if (counts_.empty()) return;
  const QRectF box = plot();
  const double last = static_cast<double>(counts_.size()) - 1.0;
  const double at = (event->pos().x() - box.left()) / std::max(1.0, box.width()) * last;
  pointed_ = static_cast<std::size_t>(std::clamp(std::round(at), 0.0, last));
  update();
}

void GenerationChart::leaveEvent(QEvent*) {
  pointed_.reset();
  update();
}

}  // namespace pneuma
