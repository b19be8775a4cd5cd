#pragma once

#include <QFrame>

#include "document/property_sheet.h"

class QGridLayout;
class QLabel;

namespace pneuma {

/// Shows a PropertySheet: the one number that matters, figures, checks with their answer.
class SheetCard : public QFrame {
  Q_OBJECT
  Q_PROPERTY(QString text READ text)

 public:
  explicit SheetCard(QWidget* parent = nullptr);

  void show(const PropertySheet& sheet);

  /// The sheet as lines of "label: value", for screen readers and scripts.
  QString text() const { return text_; }

 private:
  QLabel* headline_;
  QLabel* note_;
  QGridLayout* rows_;
  QString text_;
};

}  // namespace pneuma
