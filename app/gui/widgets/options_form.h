#pragma once

#include <QWidget>
#include <set>
#include <string>

class QGridLayout;

namespace pneuma {

class OptionsModel;

/// Spin boxes and combo boxes for the rows of an OptionsModel; knows no option in particular.
/// An editor is called "option_" + the option's name.
class OptionsForm : public QWidget {
  Q_OBJECT

 public:
  /// @param only the names to show; all others where `except` is true
  OptionsForm(OptionsModel& model, std::set<std::string> names, bool except,
              QWidget* parent = nullptr);

 private:
  void rebuild();
  void refresh();
  void addRow(int row);
  QWidget* numberEditor(int row);
  QWidget* choiceEditor(int row);

  OptionsModel& model_;
  std::set<std::string> names_;
  bool except_;
  QGridLayout* grid_;
};

}  // namespace pneuma
