#pragma once

#include <QAbstractButton>

namespace pneuma {

/// How far a step is; shown by icon and word, never by colour alone.
enum class StepState { ToDo, Running, CheckMe, Done, OutOfDate };

/// A row of the rail: state, name, one line on where the step stands, its number.
class StepButton : public QAbstractButton {
  Q_OBJECT

 public:
  StepButton(int number, const QString& title, QWidget* parent = nullptr);

  void setNumber(int number);

  /// @param note what there is to say besides the state, for example "29,953 branches"; may be
  /// empty
  void setState(StepState state, const QString& note);

  /// In one line, for windows without the height for two.
  void setCompact(bool compact);

  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void describe();
  /// What there is to say that fits whole, or the state's word.
  QString lineWithin(int width, const QFontMetrics& metrics) const;
  void paintState(QPainter& painter, const QRectF& box) const;

  int number_;
  bool compact_ = false;
  StepState state_ = StepState::ToDo;
  QString note_;
  QString line_;
};

}  // namespace pneuma
