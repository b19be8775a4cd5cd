#pragma once

#include <QWidget>
#include <string>
#include <vector>

class QGridLayout;

namespace pneuma {

class OptionsModel;

/// Of the labels, so that several forms below each other line up.
inline constexpr int FormLabelWidth = 110;
inline constexpr int NarrowLabelWidth = 74;  ///< where all labels are short

/// Editors for rows of an OptionsModel: a box for numbers, a list for choices, a tick for what is
/// off or on; knows no option in particular. An editor is called "option_" + the option's name.
class OptionsForm : public QWidget {
  Q_OBJECT

 public:
  /// @param names of the options to show, in this order
  /// @param source of the default values, for the tool tips; may be empty
  OptionsForm(OptionsModel& model, std::vector<std::string> names, const QString& source = {},
              int labelWidth = FormLabelWidth, QWidget* parent = nullptr);

 private:
  void refresh();
  void addRow(int row);
  void addSwitch(int row);
  QWidget* numberEditor(int row);
  QWidget* choiceEditor(int row);
  void describe(QWidget& editor, int row) const;

  OptionsModel& model_;
  std::vector<std::string> names_;
  QString source_;
  QGridLayout* grid_;
  bool besideSwitch_ = false;  ///< the last cell taken is a switch with room beside it
};

}  // namespace pneuma
