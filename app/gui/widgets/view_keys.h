#pragma once

#include <QString>
#include <QStringList>
#include <optional>
#include <vector>

#include "widgets/mouse_profile.h"

namespace pneuma {

/// What keys do in a slice that has the focus, beside the actions.
enum class SliceKey {
  Next,
  Previous,
  NextPage,
  PreviousPage,
  ResetFrame,
  HoldForWindow,
  RemoveLastPoint,
  DeletePoint,
  NextFissure,
  PreviousFissure
};

/// What keys do in the 3-D view while it has the focus.
enum class SceneKey {
  Look,
  FrameEverything,
  Play,
  NextFrame,
  PreviousFrame,
  Mother,
  Daughter,
  PreviousSister,
  NextSister,
  TurnLeft,
  TurnRight,
  TurnUp,
  TurnDown
};

std::optional<SliceKey> sliceKey(int key);

/// Shift counts where a key has two meanings.
std::optional<SceneKey> sceneKey(int key, Qt::KeyboardModifiers modifiers);

/// Where a key acts: while that has the focus.
enum class KeyPlace { Window, Views, Slices, Scene, Structures, Mouse };

/// One line of the overview of keys.
struct KeyRow {
  QString group;
  QString what;
  QStringList keys;  ///< as they are printed on the keyboard
  KeyPlace place = KeyPlace::Window;
};

/// What views do with keys and mouse; made of the tables that the views themselves ask.
std::vector<KeyRow> viewKeyRows(MouseProfile mouse);

}  // namespace pneuma
