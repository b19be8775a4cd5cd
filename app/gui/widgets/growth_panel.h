#pragma once

#include <QWidget>

#include "document/options_model.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace pneuma {

struct Actions;
class Document;

/// Step "Airways": method, its options, grow and cancel. The form is made from the options' fields;
/// the panel only says which of them a beginner needs.
class GrowthPanel : public QWidget {
  Q_OBJECT

 public:
  GrowthPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);

  OptionsModel& options() { return model_; }

 private:
  void bindOptions();
  void takeOptions();
  void updateNote();
  QWidget* makeForm();

  Document& document_;
  OptionsModel model_;
  QComboBox* method_;
  QPushButton* advanced_;
  QWidget* advancedForm_;
  QLabel* note_;
};

}  // namespace pneuma
