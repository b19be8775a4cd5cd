#pragma once

#include <QWidget>

#include "document/options_model.h"

class QPushButton;
class QVBoxLayout;

namespace pneuma {

class Document;

/// The options of the method that the document grows with, made from their fields: the usual ones,
/// the others under "Advanced", and links to whole sets of values.
class GrowthForm : public QWidget {
  Q_OBJECT

 public:
  explicit GrowthForm(Document& document, QWidget* parent = nullptr);

  bool advancedShown() const { return advancedShown_; }

 signals:
  void advancedToggled(bool shown);

 private:
  void rebuild();
  void follow();
  void takeOptions();
  /// The paper of the method, for tool tips.
  QString source() const;
  QWidget* makeLinks();
  QWidget* makeAdvanced();

  Document& document_;
  OptionsModel model_;
  QVBoxLayout* column_;
  QPushButton* paper_ = nullptr;
  QPushButton* defaults_ = nullptr;
  std::size_t method_ = 0;  ///< that the editors are of
  bool advancedShown_ = false;
};

}  // namespace pneuma
