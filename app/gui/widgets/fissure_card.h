#pragma once

#include <QFrame>

#include "document/fissure_editor.h"

class QLabel;
class QListWidget;
class QPushButton;

namespace pneuma {

class SliceViews;

/// One fissure and what came of it; for the one that is edited, by what it is given and its points.
class FissureCard : public QFrame {
  Q_OBJECT

 public:
  FissureCard(FissureEditor& editor, SliceViews& slices, Fissure fissure,
              QWidget* parent = nullptr);

  void follow();

 private:
  QWidget* makeMethods();
  QWidget* makePoints();
  QString nameOf(const char* part) const;

  FissureEditor& editor_;
  SliceViews& slices_;
  Fissure fissure_;
  QPushButton* name_ = nullptr;
  QPushButton* points_ = nullptr;
  QPushButton* plane_ = nullptr;
  QWidget* methods_ = nullptr;
  QLabel* state_ = nullptr;
  QWidget* edits_ = nullptr;
  QListWidget* list_ = nullptr;
  QPushButton* remove_ = nullptr;
};

}  // namespace pneuma
