#pragma once

#include <QJsonArray>
#include <QObject>
#include <QTimer>

#include "scripting.h"

namespace pneuma {

class MainWindow;
class TourCard;

/// A walk through the window on the sample chest, which a person can leave at any point. Its steps
/// are those of scripts (ScriptPlayer), of `:/tour.json`, but that nothing waits for them: "say
/// {name, text}" shows a card beside the widget of that name until "Next" is pressed, and "wait
/// {text}" goes on once no job runs.
class Tour : public QObject {
  Q_OBJECT

 public:
  explicit Tour(MainWindow& window, QObject* parent = nullptr);

  /// From the beginning, also while it is under way.
  void start();

 private:
  /// Does steps up to the next card or job.
  void go();
  void leave();
  /// Goes on once no job runs.
  void look();

  MainWindow& window_;
  ScriptPlayer player_;
  QJsonArray steps_;
  int at_ = 0;
  int stop_ = 0;  ///< cards shown so far
  int stops_ = 0;
  QTimer waiting_;
  TourCard* card_ = nullptr;
};

}  // namespace pneuma
