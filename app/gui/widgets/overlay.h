#pragma once

#include <QPointer>
#include <QWidget>

class QFrame;
class QLabel;
class QLineEdit;
class QVBoxLayout;

namespace pneuma {

/// A card above a window whose rest is dimmed: a field to type in, and what is below it. While it
/// is open no key of the window acts; Esc and a click beside the card close it, and the focus goes
/// back to where it was.
class Overlay : public QWidget {
  Q_OBJECT

 public:
  /// @param name of the card for scripts; its field is called so with "Search" behind
  Overlay(QWidget* window, const QString& name, const QString& placeholder);

  void open();

 protected:
  /// What goes below the field.
  QVBoxLayout& column() { return *column_; }

  QLineEdit& field() { return *field_; }

  /// Fills the overlay anew; something was typed.
  virtual void search(const QString& typed) = 0;

  /// A key that was pressed in the field. @return true if it was for the overlay
  virtual bool keyPressed(int key) = 0;

  /// Where the card goes in a window of that size.
  virtual QRect place(const QSize& window) const = 0;

  void close();
  void arrange();

  bool eventFilter(QObject* watched, QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  QFrame* card_;
  QVBoxLayout* column_;
  QLineEdit* field_;
  QPointer<QWidget> focusBefore_;
};

}  // namespace pneuma
