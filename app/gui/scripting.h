#pragma once

#include <QElapsedTimer>
#include <QJsonObject>
#include <QString>
#include <stdexcept>

class QObject;
class QWidget;

namespace pneuma {

class MainWindow;

/// A step of a script that cannot be done, or an expectation that does not hold.
class ScriptError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Plays a list of steps on the window as a person would: `pneuma-desktop --play FILE`. For tests
/// and for the pictures of the manual. Steps are JSON objects, each with "do":
///   open {paths}, click {name}, trigger {name}, set {name, value}, key {name, keys}, wait
///   {seconds}, pause {seconds}, click-branch {index}, click-point {name, point: [x, y, z]},
///   drag-point {name, from, to}, drag-mark {index, by: [right, down]}, wheel {name, notches,
///   times}, lap {name} (prints the seconds since the last lap), resize {width, height}, screenshot
///   {file, name, width, height} (of the window, or of one widget in it; scaled down to fit a size
///   and put in its middle), save-clipboard {file}, expect {name, property | state, equals |
///   contains | above | below}, wait-until {the same, seconds, shared}, scenario {name}: what the
///   steps from here on show
/// A limit in `seconds` that is `shared` is for a quiet machine: it grows where other programs take
/// the processor away. `name` is a widget's or action's object name. ${NAME} in a text is an
/// environment variable, ${OUT} the folder of the screenshots.
class ScriptPlayer {
 public:
  ScriptPlayer(MainWindow& window, QString outFolder);

  /// @throws ScriptError naming the step and what is wrong
  void play(const QString& file);

  /// Does one step. @throws ScriptError saying what is wrong
  void perform(const QJsonObject& step);

  /// @throws ScriptError if none is called so
  QWidget* widget(const QString& name) const;

 private:
  void expect(const QJsonObject& step) const;
  bool holds(const QJsonObject& step) const;
  QVariant observed(const QJsonObject& step) const;
  void set(const QJsonObject& step) const;
  void clickPoint(const QJsonObject& step) const;
  void dragPoint(const QJsonObject& step) const;
  void dragMark(const QJsonObject& step) const;
  void turnWheel(const QString& name, int notches) const;
  void clickBranch(int index) const;
  void screenshot(const QJsonObject& step) const;
  void saveClipboard(const QString& name) const;
  void wait(double seconds) const;
  void waitUntil(const QJsonObject& step, double seconds) const;
  void press(const QJsonObject& step) const;
  QString expanded(QString text) const;
  QObject* object(const QString& name) const;

  MainWindow& window_;
  QString outFolder_;
  QElapsedTimer lap_;
  QString scenario_;  ///< that the steps are of, for messages
};

}  // namespace pneuma
