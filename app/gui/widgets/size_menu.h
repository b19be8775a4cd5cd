#pragma once

#include <QMenu>

namespace pneuma {

/// How large text and everything else is shown, in percent of what the display says. Qt takes it
/// once, at the start of the program.
class SizeMenu : public QMenu {
  Q_OBJECT

 public:
  explicit SizeMenu(QWidget* parent);

  /// Marks the nearest of the sizes offered. Tells nobody.
  void setPercent(int percent);

 signals:
  void chosen(int percent);
};

/// Takes the size of this run, before there is an application: 80 to 200 %; what is beyond becomes
/// the nearest. A size that the environment asks for stays.
void takeSize(int percent);

}  // namespace pneuma
