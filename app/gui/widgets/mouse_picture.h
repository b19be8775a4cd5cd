#pragma once

#include <QWidget>
#include <array>
#include <utility>

#include "widgets/mouse_profile.h"

namespace pneuma {

/// A drawn mouse, and beside it what a drag of each button and the wheel do in a slice.
class MousePicture : public QWidget {
  Q_OBJECT

 public:
  explicit MousePicture(MouseProfile profile, QWidget* parent = nullptr);

  /// Room for every line of text.
  QSize sizeHint() const override;

  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  /// What is dragged or turned, and what it does.
  std::array<std::pair<QString, QString>, 4> lines() const;
  int namedWidth() const;

  MouseProfile profile_;
};

}  // namespace pneuma
