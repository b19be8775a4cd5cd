#include "script_recorder.h"

#include <QAbstractButton>
#include <QAbstractSlider>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFileDialog>
#include <QJsonDocument>
#include <QKeySequence>
#include <QLineEdit>
#include <QMimeData>
#include <QMouseEvent>
#include <QTimer>
#include <QUrl>
#include <cmath>

#include "widgets/main_window.h"
#include "widgets/slice_view.h"

namespace pneuma {

namespace {

constexpr const char* Followed = "followedByRecorder";
constexpr int WaitSeconds = 600;
constexpr int WheelNotch = 120;

QJsonObject stepOf(const char* what, const QObject& object) {
  return {{"do", what}, {"name", object.objectName()}};
}

QJsonObject settingOf(const QObject& object, const QJsonValue& value) {
  QJsonObject step = stepOf("set", object);
  step["value"] = value;
  return step;
}

/// To a tenth of a millimetre: a pixel is no finer.
QJsonArray arrayOf(const Vec3& point) {
  QJsonArray array;
  for (const double coordinate : point) array.append(std::round(10.0 * coordinate) / 10.0);
  return array;
}

bool isNamed(const QObject& object) {
  return !object.objectName().isEmpty() && !object.objectName().startsWith(QLatin1String("qt_"));
}

bool isModifier(int key) {
  return key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt ||
         key == Qt::Key_Meta || key == Qt::Key_unknown;
}

}  // namespace

ScriptRecorder::ScriptRecorder(MainWindow& window) : window_(window) {
  for (QWidget* widget : window.findChildren<QWidget*>()) follow(*widget);
  for (QAction* action : window.findChildren<QAction*>()) followAction(*action);
  connect(&window.document().jobs(), &JobQueue::busyChanged, this, [this](bool busy) {
    if (!busy) jobsEnded_ = true;
  });
  QApplication::instance()->installEventFilter(this);
}

QByteArray ScriptRecorder::text() const {
  QByteArray lines = "[\n";
  for (const auto& step : steps_) {
    lines += "  " + QJsonDocument(step.toObject()).toJson(QJsonDocument::Compact) + ",\n";
  }
  return lines + "  {\"do\":\"wait\",\"seconds\":" + QByteArray::number(WaitSeconds) + "}\n]\n";
}

void ScriptRecorder::follow(QWidget& widget) {
  if (widget.property(Followed).toBool()) return;
  widget.setProperty(Followed, true);
  if (auto* files = qobject_cast<QFileDialog*>(&widget)) followFiles(*files);
  if (auto* slice = qobject_cast<SliceView*>(&widget)) {
    connect(slice, &SliceView::hovered, this, [this](std::optional<Vec3> p) { hovered_ = p; });
  }
  if (!isNamed(widget)) return;
  if (auto* button = qobject_cast<QAbstractButton*>(&widget)) {
    connect(button, &QAbstractButton::clicked, this,
            [this, button] { note(Rank::Click, stepOf("click", *button)); });
  } else if (auto* slider = qobject_cast<QAbstractSlider*>(&widget)) {
    connect(slider, &QAbstractSlider::valueChanged, this,
            [this, slider](int value) { note(Rank::Set, settingOf(*slider, value)); });
  } else if (auto* number = qobject_cast<QDoubleSpinBox*>(&widget)) {
    connect(number, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
            [this, number](double value) { note(Rank::Set, settingOf(*number, value)); });
  } else if (auto* choice = qobject_cast<QComboBox*>(&widget)) {
    connect(choice, QOverload<int>::of(&QComboBox::activated), this,
            [this, choice] { note(Rank::Click, settingOf(*choice, choice->currentText())); });
  } else if (auto* line = qobject_cast<QLineEdit*>(&widget)) {
    connect(line, &QLineEdit::textEdited, this,
            [this, line](const QString& text) { note(Rank::Pointer, settingOf(*line, text)); });
  }
}

void ScriptRecorder::followAction(QAction& action) {
  if (!isNamed(action)) return;
  connect(&action, &QAction::triggered, this, [this, &action] {
    act();  // a key of the menu is no event that a filter sees in time
    note(Rank::Trigger, stepOf("trigger", action));
  });
}

void ScriptRecorder::followFiles(QFileDialog& dialog) {
  connect(&dialog, &QFileDialog::filesSelected, this, [this](const QStringList& files) {
    if (files.isEmpty()) return;
    finishAct();
    append({{"do", "set"}, {"name", "fileNameEdit"}, {"value", files.first()}});
    append({{"do", "pause"}, {"seconds", 0.5}});
    append({{"do", "key"}, {"name", "fileNameEdit"}, {"keys", "Return"}});
    act();
    note(Rank::File, {});
  });
}

void ScriptRecorder::act() {
  if (acting_) return;
  acting_ = true;
  QTimer::singleShot(0, this, &ScriptRecorder::finishAct);
}

void ScriptRecorder::note(Rank rank, const QJsonObject& step) {
  if (!acting_ || (rank_.has_value() && *rank_ >= rank)) return;
  rank_ = rank;
  step_ = step;
}

void ScriptRecorder::finishAct() {
  if (rank_.has_value() && !step_.isEmpty()) append(step_);
  acting_ = false;
  rank_.reset();
  step_ = {};
}

void ScriptRecorder::append(const QJsonObject& step) {
  if (jobsEnded_) steps_.append(QJsonObject{{"do", "wait"}, {"seconds", WaitSeconds}});
  const bool together = !jobsEnded_ && !steps_.isEmpty();
  jobsEnded_ = false;
  if (together) {
    QJsonObject last = steps_.last().toObject();
    if (last["do"] == step["do"] && last["name"] == step["name"]) {
      if (step["do"] == "set") {
        steps_.last() = step;
        return;
      }
      if (step["do"] == "wheel") {
        last["notches"] = last["notches"].toInt() + step["notches"].toInt();
        steps_.last() = last;
        return;
      }
    }
  }
  steps_.append(step);
}

void ScriptRecorder::pressed(const SliceView& view, const QMouseEvent& event) {
  Q_UNUSED(view);
  if (event.button() != Qt::LeftButton || event.modifiers() != Qt::NoModifier) return;
  from_ = hovered_;
  fromPixel_ = event.pos();
}

void ScriptRecorder::released(const SliceView& view, const QMouseEvent& event) {
  if (event.button() != Qt::LeftButton || !from_ || !hovered_) return;
  const bool still =
      (event.pos() - fromPixel_).manhattanLength() < QApplication::startDragDistance();
  QJsonObject step = stepOf(still ? "click-point" : "drag-point", view);
  step[still ? "point" : "from"] = arrayOf(*from_);
  if (!still) step["to"] = arrayOf(*hovered_);
  from_.reset();
  note(Rank::Pointer, step);
}

bool ScriptRecorder::eventFilter(QObject* watched, QEvent* event) {
  auto* widget = qobject_cast<QWidget*>(watched);
  if (widget == nullptr) return false;
  const auto* slice = qobject_cast<SliceView*>(widget);
  switch (event->type()) {
    case QEvent::Show:
      follow(*widget);
      break;
    case QEvent::MouseButtonPress:
      act();
      if (slice != nullptr) pressed(*slice, *static_cast<QMouseEvent*>(event));
      break;
    case QEvent::MouseMove:
      if (QApplication::mouseButtons() != Qt::NoButton) act();
      break;
    case QEvent::MouseButtonRelease:
      act();
      if (slice != nullptr) released(*slice, *static_cast<QMouseEvent*>(event));
      break;
    case QEvent::Wheel:
      act();
      if (slice != nullptr && isNamed(*widget)) {
        QJsonObject step = stepOf("wheel", *widget);
        step["notches"] = static_cast<QWheelEvent*>(event)->angleDelta().y() / WheelNotch;
        note(Rank::Pointer, step);
      }
      break;
    case QEvent::KeyPress: {
      const auto* key = static_cast<QKeyEvent*>(event);
      if (isModifier(key->key())) break;
      act();
      const bool typed = qobject_cast<QLineEdit*>(widget) != nullptr && !key->text().isEmpty() &&
                         key->text().at(0).isPrint();
      const bool enters = qobject_cast<QLineEdit*>(widget) == nullptr ||
                          key->key() == Qt::Key_Return || key->key() == Qt::Key_Escape;
      const bool number = qobject_cast<QDoubleSpinBox*>(widget) != nullptr;
      if (!isNamed(*widget) || typed || !enters || number || !widget->hasFocus()) break;
      QJsonObject step = stepOf("key", *widget);
      step["keys"] =
          QKeySequence(key->key() | static_cast<int>(key->modifiers() & ~Qt::KeypadModifier))
              .toString();
      note(Rank::Pointer, step);
      break;
    }
    case QEvent::Drop: {
      QJsonArray paths;
      for (const QUrl& url : static_cast<QDropEvent*>(event)->mimeData()->urls()) {
        if (url.isLocalFile()) paths.append(url.toLocalFile());
      }
      act();
      if (!paths.isEmpty()) note(Rank::Click, {{"do", "open"}, {"paths", paths}});
      break;
    }
    default:
      break;
  }
  return false;
}

}  // namespace pneuma
