#pragma once

#include <QWidget>

#include "document/options_model.h"

class QCheckBox;
class QLabel;
class QSlider;

namespace pneuma {

struct Actions;
class Document;
class LungEditor;
class SheetCard;
class SliceViews;

/// Step "Lungs": the threshold and the other options of the search, what the threshold takes in on
/// the slices that are shown, tools to correct lungs by hand, and what was found, with checks.
class LungsPanel : public QWidget {
  Q_OBJECT

 public:
  LungsPanel(Document& document, LungEditor& editor, SliceViews& slices, const Actions& actions,
             QWidget* parent = nullptr);

  /// Takes the threshold's colour off the slices.
  void endPreview();

 private:
  void follow();
  void takeOptions();
  void showThreshold();
  QString note() const;

  Document& document_;
  SliceViews& slices_;
  OptionsModel model_;
  QSlider* threshold_;
  QCheckBox* preview_;
  QLabel* note_;
  QLabel* heading_;
  SheetCard* found_;
};

}  // namespace pneuma
