#include "scripting.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QKeyEvent>
#include <QKeySequence>
#include <QLineEdit>
#include <QListWidget>
#include <QMouseEvent>
#include <QPainter>
#include <QScreen>
#include <QTimer>
#include <QWheelEvent>
#include <cstdio>
#include <utility>
#include <vector>

#include "machine_load.h"
#include "widgets/main_window.h"
#include "widgets/scene_view.h"
#include "widgets/slice_view.h"

namespace pneuma {

namespace {

/// Long enough for the 3-D view to draw its fine picture.
constexpr double SettleSeconds = 0.4;
constexpr int MostSettles = 20;

[[noreturn]] void fail(const QString& sentence) { throw ScriptError(sentence.toStdString()); }

void spin(double seconds) {
  QEventLoop loop;
  QTimer::singleShot(static_cast<int>(1000.0 * seconds), &loop, &QEventLoop::quit);
  loop.exec();
}

void clickAt(QWidget& target, const QPoint& at) {
  const QPoint global = target.mapToGlobal(at);
  QMouseEvent down(QEvent::MouseButtonPress, at, global, Qt::LeftButton, Qt::LeftButton,
                   Qt::NoModifier);
  QMouseEvent up(QEvent::MouseButtonRelease, at, global, Qt::LeftButton, Qt::NoButton,
                 Qt::NoModifier);
  for (QMouseEvent* event : {&down, &up}) QApplication::sendEvent(&target, event);
}

/// In some moves, as a hand would.
void dragTo(QWidget& target, const QPoint& from, const QPoint& to) {
  constexpr int Moves = 4;
  const auto send = [&](QEvent::Type type, const QPoint& at, Qt::MouseButton button,
                        Qt::MouseButtons buttons) {
    QMouseEvent event(type, at, target.mapToGlobal(at), button, buttons, Qt::NoModifier);
    QApplication::sendEvent(&target, &event);
  };
  send(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
  for (int i = 1; i <= Moves; ++i) {
    send(QEvent::MouseMove, from + (to - from) * i / Moves, Qt::NoButton, Qt::LeftButton);
    spin(0.02);
  }
  send(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
}

Vec3 pointOf(const QJsonValue& value) {
  const QJsonArray point = value.toArray();
  return {point[0].toDouble(), point[1].toDouble(), point[2].toDouble()};
}

/// The pointer is in one slice alone.
void leaveOthers(const MainWindow& window, const SliceView& here) {
  for (SliceView* view : window.findChildren<SliceView*>()) {
    if (view == &here) continue;
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(view, &leave);
  }
}

void pointAt(QWidget& target, const QPoint& at) {
  QMouseEvent move(QEvent::MouseMove, at, target.mapToGlobal(at), Qt::NoButton, Qt::NoButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&target, &move);
}

/// A picture of this size with another in its middle, made smaller if it does not fit.
QPixmap fitted(const QPixmap& picture, const QSize& size) {
  const bool fits = picture.width() <= size.width() && picture.height() <= size.height();
  const QPixmap small =
      fits ? picture : picture.scaled(size, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  QPixmap result(size);
  result.fill(Qt::gray);
  QPainter(&result).drawPixmap((size.width() - small.width()) / 2,
                               (size.height() - small.height()) / 2, small);
  return result;
}

}  // namespace

ScriptPlayer::ScriptPlayer(MainWindow& window, QString outFolder)
    : window_(window), outFolder_(std::move(outFolder)) {}

void ScriptPlayer::play(const QString& file) {
  QFile script(file);
  if (!script.open(QIODevice::ReadOnly)) fail(QStringLiteral("the script cannot be read"));
  QJsonParseError error;
  const QJsonDocument json = QJsonDocument::fromJson(script.readAll(), &error);
  if (!json.isArray()) fail(QStringLiteral("the script is no JSON list: ") + error.errorString());
  int number = 0;
  lap_.start();
  for (const auto& entry : json.array()) {
    ++number;
    const QJsonObject step = entry.toObject();
    try {
      perform(step);
    } catch (const ScriptError& problem) {
      const QString where = scenario_.isEmpty() ? QString() : scenario_ + QStringLiteral(": ");
      fail(QStringLiteral("%1step %2 %3: %4")
               .arg(where)
               .arg(number)
               .arg(QString::fromUtf8(QJsonDocument(step).toJson(QJsonDocument::Compact)),
                    QString::fromUtf8(problem.what())));
    }
  }
}

void ScriptPlayer::perform(const QJsonObject& step) {
  const QString what = step[QStringLiteral("do")].toString();
  const QString name = step[QStringLiteral("name")].toString();
  const double seconds = step[QStringLiteral("seconds")].toDouble(60.0);
  if (what == QLatin1String("scenario")) {
    scenario_ = name;
  } else if (what == QLatin1String("open")) {
    std::vector<std::filesystem::path> paths;
    for (const auto& path : step[QStringLiteral("paths")].toArray()) {
      paths.emplace_back(expanded(path.toString()).toStdString());
    }
    window_.open(std::move(paths));
  } else if (what == QLatin1String("click")) {
    auto* button = qobject_cast<QAbstractButton*>(widget(name));
    if (button == nullptr || !button->isEnabled())
      fail(QStringLiteral("no button that is enabled"));
    button->click();
  } else if (what == QLatin1String("trigger")) {
    auto* action = qobject_cast<QAction*>(object(name));
    if (action == nullptr || !action->isEnabled())
      fail(QStringLiteral("no action that is enabled"));
    action->trigger();
  } else if (what == QLatin1String("set")) {
    set(step);
  } else if (what == QLatin1String("key")) {
    press(step);
  } else if (what == QLatin1String("wait")) {
    wait(seconds);
  } else if (what == QLatin1String("wait-until")) {
    waitUntil(step, seconds);
  } else if (what == QLatin1String("pause")) {
    spin(seconds);
  } else if (what == QLatin1String("click-branch")) {
    clickBranch(step[QStringLiteral("index")].toInt());
  } else if (what == QLatin1String("click-point")) {
    clickPoint(step);
  } else if (what == QLatin1String("drag-point")) {
    dragPoint(step);
  } else if (what == QLatin1String("drag-mark")) {
    dragMark(step);
  } else if (what == QLatin1String("wheel")) {
    for (int n = step[QStringLiteral("times")].toInt(1); n > 0; --n) {
      turnWheel(name, step[QStringLiteral("notches")].toInt());
      QApplication::processEvents();  // every turn is seen
    }
  } else if (what == QLatin1String("lap")) {
    std::printf("%s: %.3f s\n", qUtf8Printable(name), 0.001 * static_cast<double>(lap_.restart()));
  } else if (what == QLatin1String("resize")) {
    window_.resize(step[QStringLiteral("width")].toInt(), step[QStringLiteral("height")].toInt());
  } else if (what == QLatin1String("screenshot")) {
    screenshot(step);
  } else if (what == QLatin1String("save-clipboard")) {
    saveClipboard(step[QStringLiteral("file")].toString());
  } else if (what == QLatin1String("expect")) {
    expect(step);
  } else {
    fail(QStringLiteral("there is no such step"));
  }
}

QString ScriptPlayer::expanded(QString text) const {
  text.replace(QStringLiteral("${OUT}"), outFolder_);
  for (int from = text.indexOf(QStringLiteral("${")); from >= 0;
       from = text.indexOf(QStringLiteral("${"), from)) {
    const int to = text.indexOf(QLatin1Char('}'), from);
    if (to < 0) break;
    const QByteArray variable = text.mid(from + 2, to - from - 2).toUtf8();
    text.replace(from, to - from + 1, qEnvironmentVariable(variable.constData()));
  }
  return text;
}

QObject* ScriptPlayer::object(const QString& name) const {
  const QList<QObject*> found = window_.findChildren<QObject*>(name);
  // Dialogs that were closed may still be there.
  for (QObject* one : found) {
    const auto* widget = qobject_cast<QWidget*>(one);
    if (widget != nullptr && widget->isVisible()) return one;
  }
  if (!found.isEmpty()) return found.first();
  fail(QStringLiteral("nothing is called '%1'").arg(name));
}

QWidget* ScriptPlayer::widget(const QString& name) const {
  if (auto* found = qobject_cast<QWidget*>(object(name))) return found;
  fail(QStringLiteral("'%1' is no widget").arg(name));
}

void ScriptPlayer::set(const QJsonObject& step) const {
  QWidget* target = widget(step[QStringLiteral("name")].toString());
  const QJsonValue value = step[QStringLiteral("value")];
  if (auto* slider = qobject_cast<QAbstractSlider*>(target)) {
    slider->setValue(value.toInt());
  } else if (auto* number = qobject_cast<QDoubleSpinBox*>(target)) {
    number->setValue(value.toDouble());
  } else if (auto* choice = qobject_cast<QComboBox*>(target)) {
    if (choice->findText(value.toString()) < 0) fail(QStringLiteral("there is no such choice"));
    choice->setCurrentText(value.toString());
  } else if (auto* list = qobject_cast<QListWidget*>(target)) {
    list->setCurrentRow(value.toInt());
  } else if (auto* button = qobject_cast<QAbstractButton*>(target)) {
    if (!button->isCheckable()) fail(QStringLiteral("this button has no value, only a click"));
    button->setChecked(value.toBool());
  } else if (auto* table = qobject_cast<QAbstractItemView*>(target)) {
    const QAbstractItemModel& model = *table->model();
    table->setCurrentIndex(model.index(value.toInt(), model.columnCount() > 1 ? 1 : 0));
  } else if (auto* line = qobject_cast<QLineEdit*>(target)) {
    line->setText(expanded(value.toString()));
  } else {
    fail(QStringLiteral("this widget has no value that can be set"));
  }
}

void ScriptPlayer::press(const QJsonObject& step) const {
  QWidget* target = widget(step[QStringLiteral("name")].toString());
  target->setFocus();
  const QKeySequence keys(step[QStringLiteral("keys")].toString());
  for (int i = 0; i < static_cast<int>(keys.count()); ++i) {
    const int code = static_cast<int>(keys[static_cast<uint>(i)]);
    const auto modifiers = Qt::KeyboardModifiers(code & static_cast<int>(Qt::KeyboardModifierMask));
    const int key = code & ~static_cast<int>(Qt::KeyboardModifierMask);
    QKeyEvent down(QEvent::KeyPress, key, modifiers);
    QKeyEvent up(QEvent::KeyRelease, key, modifiers);
    QApplication::sendEvent(target, &down);
    QApplication::sendEvent(target, &up);
  }
}

void ScriptPlayer::wait(double seconds) const {
  QElapsedTimer clock;
  clock.start();
  while (window_.document().jobs().busy()) {
    if (clock.elapsed() > 1000.0 * seconds) fail(QStringLiteral("the job is still running"));
    spin(0.01);
  }
}

void ScriptPlayer::waitUntil(const QJsonObject& step, double seconds) const {
  QElapsedTimer clock;
  clock.start();
  bool shared = step[QStringLiteral("shared")].toBool();
  while (!holds(step)) {
    if (shared && clock.elapsed() > 1000.0 * seconds) {
      seconds *= machineLoad();
      shared = false;
    }
    if (clock.elapsed() > 1000.0 * seconds) {
      fail(QStringLiteral("it is still '%1'").arg(observed(step).toString()));
    }
    spin(0.01);
  }
}

void ScriptPlayer::clickBranch(int index) const {
  const auto tree = window_.document().tree();
  if (!tree || index < 0 || static_cast<std::size_t>(index) >= tree->size()) {
    fail(QStringLiteral("there is no such branch"));
  }
  const Branch& branch = (*tree)[static_cast<std::size_t>(index)];
  SceneView& view = window_.view();
  const QPoint at = view.positionOf(0.5 * (branch.proximal + branch.distal));
  clickAt(*view.canvas(), at);
}

void ScriptPlayer::clickPoint(const QJsonObject& step) const {
  if (widget(step[QStringLiteral("name")].toString()) == window_.view().canvas()) {
    SceneView& view = window_.view();
    clickAt(*view.canvas(), view.positionOf(pointOf(step[QStringLiteral("point")])));
    return;
  }
  auto* view = qobject_cast<SliceView*>(widget(step[QStringLiteral("name")].toString()));
  if (view == nullptr || window_.slices().empty()) fail(QStringLiteral("there is no slice"));
  const QPoint at = view->positionOf(pointOf(step[QStringLiteral("point")]));
  leaveOthers(window_, *view);
  pointAt(*view, at);
  clickAt(*view, at);
}

void ScriptPlayer::dragPoint(const QJsonObject& step) const {
  auto* view = qobject_cast<SliceView*>(widget(step[QStringLiteral("name")].toString()));
  if (view == nullptr || window_.slices().empty()) fail(QStringLiteral("there is no slice"));
  leaveOthers(window_, *view);
  dragTo(*view, view->positionOf(pointOf(step[QStringLiteral("from")])),
         view->positionOf(pointOf(step[QStringLiteral("to")])));
}

void ScriptPlayer::dragMark(const QJsonObject& step) const {
  const std::vector<FissureEditor::Mark> marks = window_.fissures().marks();
  const auto index = static_cast<std::size_t>(step[QStringLiteral("index")].toInt());
  if (index >= marks.size()) fail(QStringLiteral("there is no such mark"));
  const QPoint from = window_.view().positionOf(marks[index].place);
  const QJsonArray by = step[QStringLiteral("by")].toArray();
  dragTo(*window_.view().canvas(), from, from + QPoint(by[0].toInt(), by[1].toInt()));
}

void ScriptPlayer::turnWheel(const QString& name, int notches) const {
  QWidget* target = widget(name);
  const QPoint at = target->rect().center();
  QWheelEvent event(at, target->mapToGlobal(at), {}, QPoint(0, 120 * notches), Qt::NoButton,
                    Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(target, &event);
}

void ScriptPlayer::screenshot(const QJsonObject& step) const {
  spin(SettleSeconds);
  // Lungs that stand are shown as they are, however slow the machine.
  const bool stands = window_.player().breath() && !window_.player().playing();
  for (int n = 0; stands && !window_.view().detailed() && n < MostSettles; ++n) spin(SettleSeconds);
  QDir().mkpath(outFolder_);
  QRect frame = window_.frameGeometry();
  if (step.contains(QStringLiteral("name"))) {
    const QWidget* part = widget(step[QStringLiteral("name")].toString());
    if (!part->isVisible()) fail(QStringLiteral("it is not to be seen"));
    frame = QRect(part->mapToGlobal(QPoint(0, 0)), part->size());
  }
  QPixmap shot =
      window_.screen()->grabWindow(0, frame.x(), frame.y(), frame.width(), frame.height());
  if (step.contains(QStringLiteral("width"))) {
    shot = fitted(shot,
                  {step[QStringLiteral("width")].toInt(), step[QStringLiteral("height")].toInt()});
  }
  const QString path =
      QDir(outFolder_).filePath(step[QStringLiteral("file")].toString() + QStringLiteral(".png"));
  if (!shot.save(path)) fail(QStringLiteral("the screenshot cannot be written"));
}

void ScriptPlayer::saveClipboard(const QString& name) const {
  QDir().mkpath(outFolder_);
  QFile file(QDir(outFolder_).filePath(name));
  const QByteArray text = QApplication::clipboard()->text().toUtf8();
  if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size()) {
    fail(QStringLiteral("the clipboard's text cannot be written"));
  }
}

QVariant ScriptPlayer::observed(const QJsonObject& step) const {
  const QString state = step[QStringLiteral("state")].toString();
  if (state.isEmpty()) {
    const QString property = step[QStringLiteral("property")].toString(QStringLiteral("text"));
    return object(step[QStringLiteral("name")].toString())->property(property.toUtf8().constData());
  }
  Document& document = window_.document();
  const auto tree = document.tree();
  if (state == QLatin1String("branches")) return static_cast<int>(tree ? tree->size() : 0);
  if (state == QLatin1String("grown")) {
    return static_cast<int>(tree ? document.snapshot().figures->grown : 0);
  }
  if (state == QLatin1String("lungs")) {
    const auto& lungs = document.model().lungs;
    return lungs ? lungs->right.volumeMl + lungs->left.volumeMl : 0.0;
  }
  if (state == QLatin1String("lungEdits")) {
    const auto& corrections = document.model().corrections;
    return static_cast<int>(corrections ? corrections->edits.size() : 0);
  }
  if (state == QLatin1String("surfaces")) {
    const auto& surfaces = document.model().surfaces;
    return static_cast<int>(surfaces ? surfaces->size() : 0);
  }
  if (state == QLatin1String("clipboard")) return QApplication::clipboard()->text();
  if (state == QLatin1String("modified")) return document.modified();
  if (state == QLatin1String("project")) {
    return QString::fromStdString(document.projectPath().filename().string());
  }
  if (state == QLatin1String("marks")) {
    return static_cast<int>(window_.fissures().marks().size());
  }
  if (state == QLatin1String("axial")) {
    return window_.slices().empty() ? -1 : window_.slices().slice(SlicePlane::Axial);
  }
  if (state == QLatin1String("breathing")) {
    const auto& breath = window_.player().breath();
    return static_cast<int>(breath ? breath->lungs.frames.size() : 0);
  }
  if (state == QLatin1String("playing")) return window_.player().playing();
  if (state == QLatin1String("phase")) return window_.player().phase();
  if (state == QLatin1String("frames")) return window_.view().framesDrawn();
  if (state == QLatin1String("framesPerSecond")) return window_.view().framesPerSecond();
  if (state == QLatin1String("detailed")) return window_.view().detailed();
  if (state == QLatin1String("regions"))
    return static_cast<int>(window_.regions().regions().size());
  if (state == QLatin1String("busy")) return document.jobs().busy();
  if (state == QLatin1String("previewed")) return static_cast<int>(window_.view().previewed());
  fail(QStringLiteral("there is no such state"));
}

bool ScriptPlayer::holds(const QJsonObject& step) const {
  const QVariant value = observed(step);
  const auto wanted = [&](const char* key) { return step[QString::fromUtf8(key)]; };
  const auto has = [&](const char* key) { return step.contains(QString::fromUtf8(key)); };
  bool holds = true;
  if (has("equals")) holds = holds && value.toString() == wanted("equals").toVariant().toString();
  if (has("contains")) holds = holds && value.toString().contains(wanted("contains").toString());
  if (has("above")) holds = holds && value.toDouble() > wanted("above").toDouble();
  if (has("below")) holds = holds && value.toDouble() < wanted("below").toDouble();
  return holds;
}

void ScriptPlayer::expect(const QJsonObject& step) const {
  if (!holds(step)) fail(QStringLiteral("it is '%1'").arg(observed(step).toString()));
}

}  // namespace pneuma
