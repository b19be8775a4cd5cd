#pragma once

#include <QWidget>

#include "widgets/mouse_profile.h"

namespace pneuma {

/// A drawn mouse, and beside it what a drag of each button and the wheel do in a slice.
class MousePicture : public QWidget {
  Q_OBJECT

 public:
  explicit MousePicture(MouseProfile profile, QWidget* parent = nullptr);

  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  MouseProfile profile_;
};

}  // namespace pneuma
