#pragma once

#include <QWidget>
#include <functional>

class QPainter;

namespace pneuma {

class BreathPlayer;

/// The volume of both lungs over time, and below it the loop of pressure and volume, with the
/// moment that is shown. A click or a drag in the upper one goes to a moment.
class BreathChart : public QWidget {
  Q_OBJECT

 public:
  explicit BreathChart(BreathPlayer& player, QWidget* parent = nullptr);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  /// One of the two: a box, what its axes mean, and a share of the period as a point of both axes.
  struct Plot {
    QRectF box;
    QString across;
    QString up;
    double low[2];
    double high[2];
    std::function<QPointF(double)> at;

    QPointF place(const QPointF& value) const;
  };

  Plot overTime() const;
  Plot loop() const;
  void paint(QPainter& painter, const Plot& plot) const;
  void goTo(const QPoint& position);

  BreathPlayer& player_;
};

}  // namespace pneuma
