#pragma once

#include <QWidget>

#include "document/region_editor.h"

class QListWidget;
class QPushButton;

namespace pneuma {

class NumberBox;

/// Parts of the lungs that are stiffer or softer: what a click on a lung does, how stiff, how
/// large, and the list of them.
class RegionsCard : public QWidget {
  Q_OBJECT

 public:
  explicit RegionsCard(RegionEditor& editor, QWidget* parent = nullptr);

  /// Nothing can be changed while a job runs, and nothing placed without a lung.
  void setChangeable(bool changeable);

 private:
  QPushButton* placingButton(RegionEditor::Placing placing, const QString& text, const QString& tip,
                             const char* name);
  void follow();

  RegionEditor& editor_;
  QPushButton* lobe_;
  QPushButton* ball_;
  NumberBox* factor_;
  NumberBox* radius_;
  QListWidget* list_;
  QPushButton* remove_;
};

}  // namespace pneuma
