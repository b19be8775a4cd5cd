#pragma once

#include <QMenu>
#include <array>

#include "render/stereo.h"

class QDoubleSpinBox;

namespace pneuma {

/// How the 3-D view is drawn for two eyes, and how far these are apart.
class StereoMenu : public QMenu {
  Q_OBJECT

 public:
  explicit StereoMenu(QWidget* parent);

  StereoOptions stereo() const;

  /// Tells nobody. A distance beyond what the menu allows becomes the nearest that it does.
  void setStereo(const StereoOptions& stereo);

 signals:
  void changed();

 private:
  std::array<QAction*, choices(Stereo{}).size()> kinds_{};
  QDoubleSpinBox* distance_;
};

}  // namespace pneuma
