#include "widgets/actions.h"

#include <QActionGroup>
#include <QKeySequence>
#include <QMenu>
#include <QMenuBar>

#include "document/text.h"
#include "pipeline/organs.h"
#include "widgets/icons.h"
#include "widgets/mouse_profile.h"
#include "widgets/size_menu.h"
#include "widgets/stereo_menu.h"

namespace pneuma {

namespace {

QAction* action(QWidget* window, const char* name, const QString& text,
                const QList<QKeySequence>& keys = {}, const char* icon = nullptr) {
  auto* made = new QAction(text, window);
  made->setObjectName(QString::fromUtf8(name));
  made->setShortcuts(keys);
  if (icon != nullptr) made->setIcon(themedIcon(icon));
  made->setIconVisibleInMenu(false);
  window->addAction(made);
  return made;
}

QKeySequence keys(const char* text) { return QKeySequence(QString::fromUtf8(text)); }

/// An action that the slice views alone answer: P in the 3-D view looks from behind.
QAction* inSlices(QWidget* window, const char* name, const QString& text,
                  const QList<QKeySequence>& shortcuts) {
  auto* made = new QAction(text, window);
  made->setObjectName(QString::fromUtf8(name));
  made->setShortcuts(shortcuts);
  made->setShortcutContext(Qt::WidgetShortcut);
  return made;
}

void makeFissureActions(Actions& a, QWidget* window) {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  a.placePoints =
      inSlices(window, "actionPlacePoints", tr("&Place points on fissures"), {keys("P")});
  a.placePoints->setIconText(tr("Place points"));
  a.placePoints->setCheckable(true);
  a.snap = inSlices(window, "actionSnap", tr("S&nap to the fissure in the CT"), {keys("G")});
  a.snap->setIconText(tr("Snap to CT"));
  a.snap->setCheckable(true);
  a.review = inSlices(window, "actionReview", tr("&Review the fissures"), {keys("V")});
  a.review->setIconText(tr("Review"));
  a.looksRight =
      inSlices(window, "actionLooksRight", tr("Loo&ks right"), {keys("Return"), keys("Enter")});
  a.editHere = inSlices(window, "actionEditHere", tr("&Edit here"), {keys("E")});
  a.openFissures = action(window, "actionOpenFissures", tr("Open f&issures..."));
  a.saveFissures = action(window, "actionSaveFissures", tr("Save fi&ssures..."));
  a.acceptFissures =
      action(window, "actionAcceptFissures", tr("&Accept the fissures without review"));
  a.acceptFissures->setIconText(tr("Accept"));
}

void makeLungActions(Actions& a, QWidget* window) {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  a.brush = inSlices(window, "actionBrush", tr("Paint l&ungs with a brush"), {keys("D")});
  a.brush->setIconText(tr("Brush"));
  a.eraser = inSlices(window, "actionEraser", tr("Erase lungs with a brus&h"), {keys("Shift+D")});
  a.eraser->setIconText(tr("Erase"));
  a.seed = inSlices(window, "actionSeed", tr("Grow lungs from a see&d"), {keys("T")});
  a.seed->setIconText(tr("Seed"));
  for (QAction* tool : {a.brush, a.eraser, a.seed}) tool->setCheckable(true);
  a.largerBrush = inSlices(window, "actionLargerBrush", tr("Larger brush"), {keys("+"), keys("=")});
  a.smallerBrush = inSlices(window, "actionSmallerBrush", tr("Smaller brush"), {keys("-")});
  a.openLungEdits = action(window, "actionOpenLungEdits", tr("Open lung corrections..."));
  a.saveLungEdits = action(window, "actionSaveLungEdits", tr("Save lung corrections..."));
}

void makeMouseActions(Actions& a, QWidget* window) {
  auto* group = new QActionGroup(window);
  for (const MouseHabits& habits : mouseHabits()) {
    const std::string name = std::string("actionMouse_") + habits.name;
    QAction* made = action(window, name.c_str(), QObject::tr(habits.title));
    made->setCheckable(true);
    group->addAction(made);
    a.mouse[static_cast<std::size_t>(habits.profile)] = made;
  }
  a.mouse.front()->setChecked(true);
}

}  // namespace

Actions makeActions(QWidget* window) {
  Actions a;
  const auto tr = [](const char* text) { return QObject::tr(text); };
  a.open = action(window, "actionOpen", tr("&Open files..."), {keys("Ctrl+O")}, "file");
  a.openFolder =
      action(window, "actionOpenFolder", tr("Open &folder..."), {keys("Ctrl+Shift+O")}, "folder");
  a.otherSeries = action(window, "actionOtherSeries", tr("Oth&er series..."));
  a.locateCt = action(window, "actionLocateCt", tr("&Locate the CT..."));
  a.sample = action(window, "actionSample", tr("&Try the sample chest"), {}, "lungs");
  for (const std::string_view name : organNames()) {
    const std::string objectName = "actionOrgan_" + std::string(name);
    a.organs.push_back(action(window, objectName.c_str(), organTitle(name)));
    a.organs.back()->setData(qtText(name));
  }
  a.saveProject =
      action(window, "actionSaveProject", tr("&Save project"), {keys("Ctrl+S")}, "save");
  a.saveProjectAs = action(window, "actionSaveProjectAs", tr("Save project &as..."),
                           {keys("Ctrl+Shift+S")}, "save");
  a.packCt = action(window, "actionPackCt", tr("Save the &CT in the project too"));
  a.packCt->setCheckable(true);
  for (int i = 1; i <= RecentProjects; ++i) {
    const std::string objectName = "actionRecent_" + std::to_string(i);
    a.recents.push_back(action(window, objectName.c_str(), {}));
    a.recents.back()->setVisible(false);
  }
  a.clearRecent = action(window, "actionClearRecent", tr("&Clear recent projects"));
  a.saveTree = action(window, "actionSaveTree", tr("Save &tree..."), {keys("Ctrl+E")}, "save");
  a.savePicture =
      action(window, "actionSavePicture", tr("Save &picture..."), {keys("F12")}, "camera");
  a.exportCase = action(window, "actionExportCase", tr("E&xport..."), {keys("Ctrl+Shift+E")});
  a.copyCommand =
      action(window, "actionCopyCommand", tr("Copy as co&mmand"), {keys("Ctrl+Shift+C")});
  a.quit = action(window, "actionQuit", tr("&Quit"), {keys("Ctrl+Q")});
  a.findCommand = action(window, "actionFindCommand", tr("Find a &command..."), {keys("Ctrl+K")});
  a.undo = action(window, "actionUndo", tr("&Undo"), {keys("Ctrl+Z")});
  a.redo = action(window, "actionRedo", tr("&Redo"), {keys("Ctrl+Shift+Z"), keys("Ctrl+Y")});
  a.findLungs = action(window, "actionFindLungs", tr("Find &lungs"), {keys("Ctrl+L")}, "lungs");
  makeLungActions(a, window);
  makeFissureActions(a, window);
  a.splitLobes = action(window, "actionSplitLobes", tr("&Split into lobes"), {keys("Ctrl+B")});
  a.grow = action(window, "actionGrow", tr("&Grow airways"), {keys("Ctrl+Return")});
  a.compareMethods =
      action(window, "actionCompareMethods", tr("Compare &methods"), {keys("Ctrl+M")});
  a.breathe = action(window, "actionBreathe", tr("&Breathe"), {keys("Ctrl+Shift+B")});
  a.playBreath = action(window, "actionPlayBreath", tr("&Play the breath"), {}, "play");
  a.playBreath->setCheckable(true);
  a.onionSkin = action(window, "actionOnionSkin", tr("&Onion skin"));
  a.onionSkin->setCheckable(true);
  a.saveBreath = action(window, "actionSaveBreath", tr("Save &breath..."), {}, "save");
  a.cancel = action(window, "actionCancel", tr("&Cancel the running job"), {keys("Esc")}, "close");
  for (std::size_t i = 0; i < StepNames.size(); ++i) {
    const std::string objectName = std::string("actionStep") + StepNames[i];
    a.steps[i] = action(window, objectName.c_str(), tr("Step: %1").arg(tr(StepNames[i])));
  }
  static const std::array<const char*, 6> names = {
      QT_TR_NOOP("&Anterior"), QT_TR_NOOP("&Posterior"), QT_TR_NOOP("&Left"),
      QT_TR_NOOP("&Right"),    QT_TR_NOOP("&Superior"),  QT_TR_NOOP("&Inferior")};
  for (std::size_t i = 0; i < ViewLetters.size(); ++i) {
    const std::string objectName = std::string("actionView") + ViewLetters[i];
    a.views[i] = action(window, objectName.c_str(), tr(names[i]));
    a.views[i]->setIconText(QString(QLatin1Char(ViewLetters[i])));
  }
  a.resetView = action(window, "actionResetView", tr("&Frame everything"), {}, "frame");
  a.stereo = new StereoMenu(window);
  a.slices = makeSliceActions(window);
  a.rightColumn = action(window, "actionRightColumn", tr("Structures and &properties"));
  a.rightColumn->setCheckable(true);
  a.rightColumn->setChecked(true);
  a.theme = action(window, "actionTheme", tr("&Light theme"), {});
  a.theme->setCheckable(true);
  makeMouseActions(a, window);
  a.size = new SizeMenu(window);
  a.tour = action(window, "actionTour", tr("&Tour of the window"));
  a.welcome = action(window, "actionWelcome", tr("&Welcome..."));
  a.keys = action(window, "actionKeys", tr("&Keys"), {keys("?")});
  a.about = action(window, "actionAbout", tr("&About Pneuma"));
  return a;
}

QMenu* organMenu(const Actions& a, QWidget* parent) {
  auto* menu = new QMenu(QObject::tr("Open a &built-in organ"), parent);
  for (QAction* organ : a.organs) menu->addAction(organ);
  return menu;
}

void fillMenus(QMenuBar& bar, const Actions& a) {
  QMenu* file = bar.addMenu(QObject::tr("&File"));
  file->addActions({a.open, a.openFolder, a.sample});
  file->addMenu(organMenu(a, file));
  QMenu* recent = file->addMenu(QObject::tr("Open &recent"));
  for (QAction* project : a.recents) recent->addAction(project);
  recent->addSeparator();
  recent->addAction(a.clearRecent);
  file->addSeparator();
  file->addActions({a.otherSeries, a.locateCt});
  file->addSeparator();
  file->addActions({a.saveProject, a.saveProjectAs, a.packCt});
  file->addSeparator();
  file->addActions({a.openLungEdits, a.saveLungEdits});
  file->addActions({a.openFissures, a.saveFissures});
  file->addSeparator();
  file->addActions({a.exportCase, a.saveTree, a.saveBreath, a.savePicture});
  file->addSeparator();
  file->addAction(a.quit);
  QMenu* edit = bar.addMenu(QObject::tr("&Edit"));
  edit->addActions({a.undo, a.redo, a.findCommand});
  edit->addSeparator();
  edit->addAction(a.copyCommand);
  edit->addSeparator();
  edit->addActions({a.brush, a.eraser, a.seed, a.largerBrush, a.smallerBrush});
  edit->addSeparator();
  edit->addActions({a.placePoints, a.snap, a.review, a.looksRight, a.editHere, a.acceptFissures});
  edit->addSeparator();
  edit->addActions({a.findLungs, a.splitLobes, a.grow, a.compareMethods, a.breathe, a.cancel});
  QMenu* view = bar.addMenu(QObject::tr("&View"));
  QMenu* steps = view->addMenu(QObject::tr("S&teps"));
  for (QAction* step : a.steps) steps->addAction(step);
  for (QAction* named : a.views) view->addAction(named);
  view->addSeparator();
  view->addAction(a.resetView);
  view->addMenu(a.stereo);
  view->addActions({a.playBreath, a.onionSkin, a.rightColumn, a.theme});
  QMenu* mouse = view->addMenu(QObject::tr("&Mouse in slices"));
  for (QAction* habits : a.mouse) mouse->addAction(habits);
  view->addMenu(a.size);
  fillSliceMenu(*bar.addMenu(QObject::tr("&Slices")), a.slices);
  QMenu* help = bar.addMenu(QObject::tr("&Help"));
  help->addActions({a.keys, a.tour, a.welcome, a.about});
}

}  // namespace pneuma
