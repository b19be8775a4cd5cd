#pragma once

#include <QWidget>
#include <vector>

#include "document/fissure_editor.h"

class QBoxLayout;
class QLabel;
class QLineEdit;
class QSlider;
class QTimer;

namespace pneuma {

struct Actions;
class FissureCard;
class SheetCard;
class ReviewWalk;
class SliceViews;

/// Step "Lobes": a card for every fissure, snapping, splitting, the volumes of the lobes with
/// checks, review, how much the fissures bend, wanted volumes.
class LobesPanel : public QWidget {
  Q_OBJECT

 public:
  LobesPanel(Document& document, FissureEditor& editor, ReviewWalk& review, SliceViews& slices,
             const Actions& actions, QWidget* parent = nullptr);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void addFiles(QBoxLayout& column, const Actions& actions);
  void addTools(QBoxLayout& column, const Actions& actions);
  void addStation(QBoxLayout& column, const Actions& actions);
  void addReview(QBoxLayout& column, const Actions& actions);
  void addSmoothness(QBoxLayout& column);
  void addShares(QBoxLayout& column);
  void addSplit(QBoxLayout& column, const Actions& actions);
  void follow();
  void takeShares();
  /// True if the volumes that stand in their box are those that are wanted.
  bool showsShares() const;
  void followReview();
  /// Gives the column the height that it needs.
  void fit();
  QString note() const;
  QString snapNote() const;

  Document& document_;
  FissureEditor& editor_;
  ReviewWalk& review_;
  std::vector<FissureCard*> cards_;
  QSlider* smoothness_;
  QLabel* smoothnessValue_;
  QWidget* column_;
  QTimer* fitting_;
  QLineEdit* shares_;
  QLabel* sharesNote_;
  QLabel* note_;
  QLabel* snapNote_;
  QLabel* reviewNote_;
  QLabel* station_;
  QWidget* walking_;  ///< what there is to say at a station
  QWidget* waiting_;  ///< what begins a review
  SheetCard* volumes_;
  SheetCard* checks_;
};

}  // namespace pneuma
