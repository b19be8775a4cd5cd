#pragma once

#include <QWidget>

#include "document/slice_views.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace pneuma {

struct Actions;

/// Above the slices: their window, and how labels lie over them.
class SliceBar : public QWidget {
  Q_OBJECT

 public:
  SliceBar(SliceViews& views, const Actions& actions, QWidget* parent = nullptr);

 private:
  void follow();
  QDoubleSpinBox* huBox(const char* name, const QString& spoken, double least, double most);

  SliceViews& views_;
  QComboBox* preset_;
  QDoubleSpinBox* width_;
  QDoubleSpinBox* level_;
  QSlider* opacity_;
  QLabel* opacityLabel_;
};

}  // namespace pneuma
