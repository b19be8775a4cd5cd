#pragma once

#include <QAction>
#include <array>
#include <vector>

#include "widgets/slice_actions.h"

class QMenu;
class QMenuBar;

namespace pneuma {

class SizeMenu;
class StereoMenu;

/// The six named views, by letter.
inline constexpr std::array<char, 6> ViewLetters = {'A', 'P', 'L', 'R', 'S', 'I'};

/// The steps, as they are called in the window before it is translated.
inline constexpr std::array<const char*, 6> StepNames = {
    QT_TR_NOOP("Open"),    QT_TR_NOOP("Lungs"),     QT_TR_NOOP("Lobes"),
    QT_TR_NOOP("Airways"), QT_TR_NOOP("Breathing"), QT_TR_NOOP("Export")};

/// So many projects are offered to be opened again.
inline constexpr int RecentProjects = 8;

/// Everything the window can be told to do; menus, buttons and keys share these.
struct Actions {
  QAction* open = nullptr;
  QAction* openFolder = nullptr;
  QAction* otherSeries = nullptr;
  QAction* locateCt = nullptr;
  QAction* sample = nullptr;
  std::vector<QAction*> organs;  ///< one for each of organNames(), which is its data()
  QAction* saveProject = nullptr;
  QAction* saveProjectAs = nullptr;
  QAction* packCt = nullptr;      ///< checkable: the CT goes into the project
  std::vector<QAction*> recents;  ///< projects of late, each one's path its data(); hidden: none
  QAction* clearRecent = nullptr;
  QAction* saveTree = nullptr;
  QAction* savePicture = nullptr;
  QAction* exportCase = nullptr;
  QAction* copyCommand = nullptr;  ///< of the step that is shown
  QAction* quit = nullptr;
  QAction* findCommand = nullptr;
  QAction* undo = nullptr;
  QAction* redo = nullptr;
  QAction* findLungs = nullptr;
  QAction* placePoints = nullptr;  ///< checkable; its key acts in the slices
  QAction* snap = nullptr;         ///< checkable; so does its key
  QAction* openFissures = nullptr;
  QAction* saveFissures = nullptr;
  QAction* brush =
      nullptr;  ///< checkable; the keys of this one and the next four act in the slices
  QAction* eraser = nullptr;  ///< checkable
  QAction* seed = nullptr;    ///< checkable
  QAction* largerBrush = nullptr;
  QAction* smallerBrush = nullptr;
  QAction* openLungEdits = nullptr;
  QAction* saveLungEdits = nullptr;
  QAction* splitLobes = nullptr;
  QAction* review = nullptr;  ///< the keys of this one and the next two act in the slices
  QAction* looksRight = nullptr;
  QAction* editHere = nullptr;
  QAction* acceptFissures = nullptr;
  QAction* grow = nullptr;
  QAction* compareMethods = nullptr;
  QAction* breathe = nullptr;
  QAction* playBreath = nullptr;  ///< checkable; its key acts in the 3-D view
  QAction* onionSkin = nullptr;   ///< checkable
  QAction* saveBreath = nullptr;
  QAction* cancel = nullptr;
  std::array<QAction*, StepNames.size()> steps{};  ///< each goes to one; hidden where the step is
  std::array<QAction*, 6> views{};
  QAction* resetView = nullptr;
  StereoMenu* stereo = nullptr;
  SliceActions slices;
  QAction* rightColumn = nullptr;  ///< checkable: structures and properties are shown
  QAction* theme = nullptr;
  std::array<QAction*, 3> mouse{};  ///< one for each of mouseHabits(), in a group
  SizeMenu* size = nullptr;
  QAction* tour = nullptr;
  QAction* welcome = nullptr;
  QAction* keys = nullptr;
  QAction* about = nullptr;

  /// Those of the fissures whose keys act in the slices.
  QList<QAction*> ofFissures() const { return {placePoints, snap, review, looksRight, editHere}; }

  /// Those of correcting lungs, likewise.
  QList<QAction*> ofLungs() const { return {brush, eraser, seed, largerBrush, smallerBrush}; }
};

/// @param window owns the actions and answers their keys
Actions makeActions(QWidget* window);

/// A menu of the built-in organs.
QMenu* organMenu(const Actions& actions, QWidget* parent);

void fillMenus(QMenuBar& bar, const Actions& actions);

}  // namespace pneuma
