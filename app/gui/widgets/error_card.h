#pragma once

#include <QFrame>

class QLabel;
class QPushButton;

namespace pneuma {

/// Says what went wrong and what to do, above the view and in nobody's way: nothing is modal.
class ErrorCard : public QFrame {
  Q_OBJECT

 public:
  /// @param parent the widget over whose upper edge it floats
  explicit ErrorCard(QWidget* parent);

  void show(const QString& title, const QString& sentence);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QLabel* title_;
  QLabel* sentence_;
  QPushButton* copy_;
};

}  // namespace pneuma
