#pragma once

#include <QDoubleSpinBox>

namespace pneuma {

/// A number that shows as many decimals as its value has, and whole numbers in groups.
class NumberBox : public QDoubleSpinBox {
  Q_OBJECT

 public:
  explicit NumberBox(QWidget* parent = nullptr);

  QString textFromValue(double value) const override;
};

}  // namespace pneuma
