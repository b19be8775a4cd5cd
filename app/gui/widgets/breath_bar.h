#pragma once

#include <QWidget>

class QComboBox;
class QLabel;
class QSlider;
class QToolButton;

namespace pneuma {

struct Actions;
class BreathPlayer;

/// The timeline below the views: play, the moment of the breath, how fast, and what colours the
/// lungs.
class BreathBar : public QWidget {
  Q_OBJECT

 public:
  BreathBar(BreathPlayer& player, const Actions& actions, QWidget* parent = nullptr);

 private:
  void showMoment();
  void follow();

  BreathPlayer& player_;
  QToolButton* play_;
  QSlider* phase_;
  QLabel* moment_;
  QComboBox* speed_;
  QComboBox* colour_;
};

}  // namespace pneuma
