#pragma once

#include <QWidget>
#include <vector>

#include "document/fissure_editor.h"

class QBoxLayout;
class QLabel;
class QLineEdit;
class QSlider;

namespace pneuma {

struct Actions;
class FissureCard;
class SheetCard;
class SliceViews;

/// Step "Lobes": a card for every fissure, how much they bend, wanted volumes, splitting, and the
/// volumes of the lobes with checks.
class LobesPanel : public QWidget {
  Q_OBJECT

 public:
  LobesPanel(Document& document, FissureEditor& editor, SliceViews& slices, const Actions& actions,
             QWidget* parent = nullptr);

 private:
  void addSmoothness(QBoxLayout& column);
  void addShares(QBoxLayout& column);
  void addSplit(QBoxLayout& column, const Actions& actions);
  void follow();
  void takeShares();
  QString note() const;

  Document& document_;
  FissureEditor& editor_;
  std::vector<FissureCard*> cards_;
  QSlider* smoothness_;
  QLabel* smoothnessValue_;
  QLineEdit* shares_;
  QLabel* sharesNote_;
  QLabel* note_;
  SheetCard* volumes_;
  SheetCard* checks_;
};

}  // namespace pneuma
