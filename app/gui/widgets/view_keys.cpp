#include "widgets/view_keys.h"

#include <QKeySequence>
#include <QObject>
#include <utility>

namespace pneuma {

namespace {

struct SliceRow {
  SliceKey does;
  std::vector<int> keys;
  const char* what;
};

struct SceneRow {
  SceneKey does;
  std::vector<int> keys;
  bool shift;
  const char* what;
};

const std::vector<SliceRow>& sliceRows() {
  static const std::vector<SliceRow> rows = {
      {SliceKey::Next, {Qt::Key_Up, Qt::Key_F}, QT_TR_NOOP("Next slice")},
      {SliceKey::Previous, {Qt::Key_Down, Qt::Key_B}, QT_TR_NOOP("Previous slice")},
      {SliceKey::NextPage, {Qt::Key_PageUp}, QT_TR_NOOP("Ten slices on")},
      {SliceKey::PreviousPage, {Qt::Key_PageDown}, QT_TR_NOOP("Ten slices back")},
      {SliceKey::ResetFrame, {Qt::Key_R}, QT_TR_NOOP("Show the whole slice")},
      {SliceKey::HoldForWindow,
       {Qt::Key_W},
       QT_TR_NOOP("Held while dragging: window and level of the grey")},
      {SliceKey::RemoveLastPoint,
       {Qt::Key_Backspace},
       QT_TR_NOOP("Lobes: remove the last point of the fissure")},
      {SliceKey::DeletePoint,
       {Qt::Key_Delete},
       QT_TR_NOOP("Lobes: remove the point under the pointer")},
      {SliceKey::NextFissure, {Qt::Key_Tab}, QT_TR_NOOP("Lobes: next fissure")},
      {SliceKey::PreviousFissure, {Qt::Key_Backtab}, QT_TR_NOOP("Lobes: previous fissure")}};
  return rows;
}

const std::vector<SceneRow>& sceneRows() {
  static const std::vector<SceneRow> rows = {
      {SceneKey::Look,
       {Qt::Key_A, Qt::Key_P, Qt::Key_L, Qt::Key_R, Qt::Key_S, Qt::Key_I},
       false,
       QT_TR_NOOP("Look from the front, behind, left, right, above, below")},
      {SceneKey::FrameEverything, {Qt::Key_Home}, false, QT_TR_NOOP("Frame everything")},
      {SceneKey::TurnLeft, {Qt::Key_Left}, true, QT_TR_NOOP("Turn to the left")},
      {SceneKey::TurnRight, {Qt::Key_Right}, true, QT_TR_NOOP("Turn to the right")},
      {SceneKey::TurnUp, {Qt::Key_Up}, true, QT_TR_NOOP("Turn upwards")},
      {SceneKey::TurnDown, {Qt::Key_Down}, true, QT_TR_NOOP("Turn downwards")},
      {SceneKey::Mother, {Qt::Key_Up}, false, QT_TR_NOOP("To the mother branch")},
      {SceneKey::Daughter, {Qt::Key_Down}, false, QT_TR_NOOP("To the daughter branch")},
      {SceneKey::PreviousSister, {Qt::Key_Left}, false, QT_TR_NOOP("To the previous sister")},
      {SceneKey::NextSister, {Qt::Key_Right}, false, QT_TR_NOOP("To the next sister")},
      {SceneKey::Play, {Qt::Key_Space}, false, QT_TR_NOOP("Play the breath, or stand still")},
      {SceneKey::PreviousFrame, {Qt::Key_Comma}, false, QT_TR_NOOP("Breath: one frame back")},
      {SceneKey::NextFrame, {Qt::Key_Period}, false, QT_TR_NOOP("Breath: one frame on")}};
  return rows;
}

struct MouseRow {
  bool inSlices;
  const char* how;
  const char* what;
};

constexpr MouseRow MouseRows[] = {
    {true, QT_TR_NOOP("Click"), QT_TR_NOOP("Move the crosshair; all views go there")},
    {true, QT_TR_NOOP("Wheel"), QT_TR_NOOP("Next and previous slice; with Shift five at a time")},
    {true, QT_TR_NOOP("Ctrl+Wheel"), QT_TR_NOOP("Zoom about the pointer")},
    {true, QT_TR_NOOP("Shift+left drag"), QT_TR_NOOP("Move the picture")},
    {true, QT_TR_NOOP("Double click"), QT_TR_NOOP("This view alone, and back")},
    {true, QT_TR_NOOP("Drag with a brush"), QT_TR_NOOP("Lungs: paint or erase in the circle")},
    {true, QT_TR_NOOP("Click with a seed"), QT_TR_NOOP("Lungs: take in what hangs together there")},
    {false, QT_TR_NOOP("Drag"), QT_TR_NOOP("Turn")},
    {false, QT_TR_NOOP("Middle drag"), QT_TR_NOOP("Move; so does Shift+left drag")},
    {false, QT_TR_NOOP("Wheel"), QT_TR_NOOP("Zoom; so does a right drag")},
    {false, QT_TR_NOOP("Click"), QT_TR_NOOP("Select the branch under the pointer")}};

/// As it is printed on the keyboard.
QString keyText(int key, bool shift) {
  if (key == Qt::Key_Backtab) return QStringLiteral("Shift+Tab");
  return QKeySequence(shift ? key | Qt::SHIFT : key).toString(QKeySequence::NativeText);
}

template <class Row>
KeyRow keyRow(const Row& row, const QString& group, KeyPlace place, bool shift) {
  QStringList keys;
  for (const int key : row.keys) keys << keyText(key, shift);
  return {group, QObject::tr(row.what), keys, place};
}

}  // namespace

std::optional<SliceKey> sliceKey(int key) {
  for (const SliceRow& row : sliceRows()) {
    for (const int one : row.keys) {
      if (one == key) return row.does;
    }
  }
  return std::nullopt;
}

std::optional<SceneKey> sceneKey(int key, Qt::KeyboardModifiers modifiers) {
  std::optional<SceneKey> plain;
  for (const SceneRow& row : sceneRows()) {
    for (const int one : row.keys) {
      if (one != key) continue;
      if (row.shift == modifiers.testFlag(Qt::ShiftModifier)) return row.does;
      if (!row.shift) plain = row.does;
    }
  }
  return plain;
}

std::vector<KeyRow> viewKeyRows(MouseProfile mouse) {
  std::vector<KeyRow> rows;
  const QString slices = QObject::tr("In a slice");
  for (const SliceRow& row : sliceRows()) {
    rows.push_back(keyRow(row, slices, KeyPlace::Slices, false));
  }
  const QString scene = QObject::tr("In the 3-D view");
  for (const SceneRow& row : sceneRows()) {
    rows.push_back(keyRow(row, scene, KeyPlace::Scene, row.shift));
  }
  rows.push_back({QObject::tr("In the list of structures"),
                  QObject::tr("Show or hide it"),
                  {keyText(Qt::Key_Space, false)},
                  KeyPlace::Structures});
  rows.push_back({QObject::tr("In the list of structures"),
                  QObject::tr("Draw a lobe denser, fainter"),
                  {keyText(Qt::Key_BracketRight, false), keyText(Qt::Key_BracketLeft, false)},
                  KeyPlace::Structures});
  const QString mouseInSlices = QObject::tr("Mouse in a slice");
  const MouseHabits& habits = habitsOf(mouse);
  for (const auto& [how, drag] : {std::pair{QObject::tr("Left drag"), habits.left},
                                  std::pair{QObject::tr("Middle drag"), habits.middle},
                                  std::pair{QObject::tr("Right drag"), habits.right}}) {
    rows.push_back({mouseInSlices, dragText(drag), {how}, KeyPlace::Mouse});
  }
  for (const MouseRow& row : MouseRows) {
    rows.push_back({row.inSlices ? mouseInSlices : QObject::tr("Mouse in the 3-D view"),
                    QObject::tr(row.what),
                    {QObject::tr(row.how)},
                    KeyPlace::Mouse});
  }
  return rows;
}

}  // namespace pneuma
