#pragma once

#include <QFrame>

class QAction;
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

  /// The same with a button for what helps.
  void show(const QString& title, const QString& sentence, QAction& help);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QAction* action_ = nullptr;  ///< of help_
  QPushButton* help_;
  QLabel* title_;
  QLabel* sentence_;
  QPushButton* copy_;
};

}  // namespace pneuma
