#pragma once

#include <QElapsedTimer>
#include <QJsonArray>
#include <QJsonObject>
#include <QObject>
#include <QPoint>
#include <optional>

#include "core/math.h"

class QAction;
class QFileDialog;
class QMouseEvent;

namespace pneuma {

class MainWindow;
class SliceView;

/// Writes down what a person does in the window as steps that ScriptPlayer plays:
/// `pneuma-desktop --record FILE`. One step for one act: a button clicked, an action triggered by
/// menu or key, a value set, a key or a click, drag or turn of the wheel in a slice, a file chosen
/// or dropped; a "wait" before the first act after a job. What is done to objects without a name is
/// not recorded, nor are the turns of the 3-D view and clicks in it.
class ScriptRecorder : public QObject {
  Q_OBJECT

 public:
  /// Records from now on.
  explicit ScriptRecorder(MainWindow& window);

  const QJsonArray& steps() const { return steps_; }

  /// The script as it stands in a file. It ends once all jobs are done.
  QByteArray text() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// What is told of an act: of all that it does the last of these, as the others follow from it.
  enum class Rank { Set, Pointer, Trigger, Click, File };

  void follow(QWidget& widget);
  void followAction(QAction& action);
  void followFiles(QFileDialog& dialog);
  void act();
  void note(Rank rank, const QJsonObject& step);
  void finishAct();
  void append(const QJsonObject& step);
  void pressed(const SliceView& view, const QMouseEvent& event);
  void released(const SliceView& view, const QMouseEvent& event);

  MainWindow& window_;
  QJsonArray steps_;
  bool acting_ = false;  ///< a person's event is being worked on
  std::optional<Rank> rank_;
  QJsonObject step_;
  bool jobsEnded_ = false;       ///< since the last step
  std::optional<Vec3> hovered_;  ///< point of the slice under the pointer, LPS, mm
  std::optional<Vec3> from_;     ///< where a drag began
  QPoint fromPixel_;
};

}  // namespace pneuma
