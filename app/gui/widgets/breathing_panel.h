#pragma once

#include <QWidget>

#include "document/options_model.h"

class QLabel;

namespace pneuma {

struct Actions;
class Document;
class PersonCard;
class RegionEditor;
class RegionsCard;
class SheetCard;

/// Step "Breathing": how the lungs shall breathe, what the breath is like, and its checks.
class BreathingPanel : public QWidget {
  Q_OBJECT

 public:
  BreathingPanel(Document& document, RegionEditor& regions, const Actions& actions,
                 QWidget* parent = nullptr);

 private:
  void follow();
  QString note() const;

  Document& document_;
  OptionsModel model_;
  PersonCard* person_;
  RegionsCard* regions_;
  QLabel* note_;
  QLabel* heading_;
  SheetCard* breath_;
};

}  // namespace pneuma
