#pragma once

#include <QJsonArray>
#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

#include "document/document.h"
#include "scripting.h"

namespace pneuma {

class MainWindow;
class TourCard;

/// A walk through the window on the sample chest, which a person can leave at any point. Its steps
/// are those of scripts (ScriptPlayer), of `:/tour.json`, but that nothing waits for them: "say
/// {name, text}" shows a card beside the widget of that name until "Next" is pressed, and "wait
/// {text}" goes on once no job runs. It goes on with the sample alone: once another case is open,
/// it ends. What growth was set to is set again at its end.
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
  /// Says that it cannot go on.
  void giveUp();
  void keepOptions();
  void giveOptionsBack();

  MainWindow& window_;
  ScriptPlayer player_;
  QJsonArray steps_;
  int at_ = 0;
  int stop_ = 0;  ///< cards shown so far
  int stops_ = 0;
  QTimer waiting_;
  TourCard* card_ = nullptr;
  std::shared_ptr<const std::vector<LobeSurface>> before_;  ///< what was open when it began
  std::shared_ptr<const std::vector<LobeSurface>> sample_;  ///< null until it is open
  std::vector<GrowthOptions> options_;                      ///< of every method before it; or none
  std::optional<GrowthOptions> chosen_;                     ///< those to grow with, of them
};

}  // namespace pneuma
