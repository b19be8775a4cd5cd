#pragma once

#include <QFrame>
#include <QPointer>

class QLabel;
class QPushButton;

namespace pneuma {

/// A card of the tour beside the widget that it tells of, which gets a frame.
class TourCard : public QFrame {
  Q_OBJECT

 public:
  explicit TourCard(QWidget* window);
  ~TourCard() override;

  /// @param about what may be hidden: the card is in the middle then
  /// @param number of this stop, from 1, of so many
  void tell(QWidget* about, const QString& text, int number, int count);

  /// Something happens; the next stop comes by itself.
  void waitFor(const QString& what);

 signals:
  void next();
  void left();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void arrange();

  QLabel* text_;
  QLabel* count_;
  QPushButton* next_;
  QPushButton* leave_;
  QPointer<QWidget> frame_;  ///< around what the card tells of
  QPointer<QWidget> about_;
};

}  // namespace pneuma
