#pragma once

#include <QFrame>

class QGridLayout;
class QLabel;

namespace pneuma {

struct EfficiencyTable;

/// The efficiency functions of a grown tree, by the paper's and by today's definitions.
class EfficiencyCard : public QFrame {
  Q_OBJECT
  Q_PROPERTY(QString text READ text)

 public:
  explicit EfficiencyCard(QWidget* parent = nullptr);

  void show(const EfficiencyTable& table);

  /// The table as lines of "name: paper, today", for screen readers and scripts.
  QString text() const { return text_; }

 private:
  QGridLayout* grid_;
  QLabel* note_;
  QString text_;
};

}  // namespace pneuma
