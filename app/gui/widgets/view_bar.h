#pragma once

#include <QWidget>

#include "render/scene.h"
#include "widgets/actions.h"

class QComboBox;
class QLabel;
class QSlider;

namespace pneuma {

/// Above the 3-D view: what the airways are coloured by, how deep they are shown, how dense the
/// lobes are, and the six named views.
class ViewBar : public QWidget {
  Q_OBJECT

 public:
  ViewBar(const Actions& actions, QWidget* parent = nullptr);

  /// The look chosen here put into `options`.
  SceneOptions applied(SceneOptions options) const;

  /// The deepest generation there is; the slider goes as far.
  void setDeepest(int generation);

  /// False where there is no surface whose density could be chosen, as in a built-in organ.
  void setLobes(bool any);

 signals:
  void changed();

 private:
  void updateLabels();

  QComboBox* colourBy_;
  QLabel* generationLabel_;
  QSlider* generation_;
  QLabel* opacityLabel_;
  QSlider* opacity_;
};

}  // namespace pneuma
