#pragma once

#include <QFrame>
#include <array>

#include "document/fissure_editor.h"

class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QPushButton;

namespace pneuma {

class SliceViews;

/// One fissure and what came of it, in a line; for the one that is edited, by what it is given:
/// its points, the angles of its plane, or its file.
class FissureCard : public QFrame {
  Q_OBJECT

 public:
  FissureCard(Document& document, FissureEditor& editor, SliceViews& slices, Fissure fissure,
              QWidget* parent = nullptr);

  void follow();

 private:
  QWidget* makeMethods();
  QWidget* makePoints();
  QWidget* makeAngles();
  QDoubleSpinBox* makeAngle(const char* name, const QString& accessible, const QString& tip);
  void chooseMethod(FissureMethod method);
  void askForSurface();
  void followPoints();
  void followAngles();
  void followSelection();
  QString nameOf(const char* part) const;

  Document& document_;
  FissureEditor& editor_;
  SliceViews& slices_;
  Fissure fissure_;
  QPushButton* name_ = nullptr;
  QLabel* brief_ = nullptr;
  std::array<QPushButton*, 3> methodButtons_{};  ///< in the order of FissureMethod
  QWidget* methods_ = nullptr;
  QLabel* state_ = nullptr;
  QLabel* shows_ = nullptr;
  QWidget* points_ = nullptr;
  QListWidget* list_ = nullptr;
  QPushButton* remove_ = nullptr;
  QDoubleSpinBox* weight_ = nullptr;
  QWidget* angles_ = nullptr;
  QDoubleSpinBox* tilt_ = nullptr;
  QDoubleSpinBox* turn_ = nullptr;
  QPushButton* extend_ = nullptr;
};

}  // namespace pneuma
