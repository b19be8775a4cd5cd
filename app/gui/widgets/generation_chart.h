#pragma once

#include <QWidget>
#include <cstddef>
#include <optional>
#include <vector>

namespace pneuma {

/// Branches per generation on a logarithmic axis.
class GenerationChart : public QWidget {
  Q_OBJECT

 public:
  explicit GenerationChart(QWidget* parent = nullptr);

  void show(std::vector<std::size_t> branchesOfGeneration);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  QRectF plot() const;
  QPointF pointOf(std::size_t generation) const;
  void paintAxes(QPainter& painter) const;
  void paintPointed(QPainter& painter) const;
  int decades() const;

  std::vector<std::size_t> counts_;
  std::optional<std::size_t> pointed_;
};

}  // namespace pneuma
