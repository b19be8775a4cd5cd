#pragma once

#include <QWidget>

#include "document/lung_editor.h"

class QCheckBox;
class QComboBox;
class QLabel;

namespace pneuma {

struct Actions;
class NumberBox;

/// Brush, eraser and seed: which of them, how large, for which lung, and how often lungs were
/// corrected.
class LungToolsCard : public QWidget {
  Q_OBJECT

 public:
  LungToolsCard(Document& document, LungEditor& editor, const Actions& actions,
                QWidget* parent = nullptr);

 private:
  void follow();

  Document& document_;
  LungEditor& editor_;
  NumberBox* radius_;
  QComboBox* shape_;
  QComboBox* lung_;
  QCheckBox* limited_;
  NumberBox* limit_;
  QLabel* note_;
};

}  // namespace pneuma
