#pragma once

#include <QWidget>

class QButtonGroup;
class QLabel;
class QLayout;

namespace pneuma {

struct Actions;
class Document;
class EfficiencyCard;
class GrowthForm;

/// Step "Airways": a tab for every growth method with its options, grow and cancel, and the
/// efficiency functions of what was grown.
class GrowthPanel : public QWidget {
  Q_OBJECT

 public:
  GrowthPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void follow();
  void showEfficiency();
  QString note() const;
  QWidget* makeTabs();
  QLayout* makeButtons(const Actions& actions);

  Document& document_;
  QButtonGroup* tabs_;
  GrowthForm* form_;
  QLabel* note_;
  EfficiencyCard* efficiency_;
  bool grown_ = false;  ///< there is an efficiency to show
};

}  // namespace pneuma
