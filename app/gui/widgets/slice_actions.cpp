#include "widgets/slice_actions.h"

#include <QKeySequence>
#include <QMenu>

#include "document/text.h"
#include "render/grey_window.h"

namespace pneuma {

namespace {

QAction* action(QObject* owner, const QString& name, const QString& text, const char* keys) {
  auto* made = new QAction(text, owner);
  made->setObjectName(name);
  made->setShortcut(QKeySequence(QString::fromUtf8(keys)));
  made->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  return made;
}

QAction* checkable(QAction* action, bool on) {
  action->setCheckable(true);
  action->setChecked(on);
  return action;
}

}  // namespace

QList<QAction*> SliceActions::all() const {
  QList<QAction*> list;
  for (QAction* window : windows) list << window;
  return list << overlay << outlines << denser << fainter << annotations << crosshair << fourViews
              << sceneAlone;
}

SliceActions makeSliceActions(QObject* owner) {
  SliceActions a;
  const auto tr = [](const char* text) { return QObject::tr(text); };
  static const std::array<const char*, 5> keys = {"F5", "F6", "F7", "F8", "F9"};
  for (std::size_t i = 0; i < a.windows.size(); ++i) {
    const NamedWindow& named = greyWindows()[i];
    a.windows[i] = action(owner, QStringLiteral("actionWindow_") + qtText(named.name),
                          tr("Window: %1").arg(qtText(named.title)), keys[i]);
    a.windows[i]->setShortcutContext(Qt::WindowShortcut);
  }
  const auto made = [&](const char* name, const char* text, const char* key) {
    return action(owner, QString::fromUtf8(name), tr(text), key);
  };
  a.overlay = checkable(made("actionOverlay", "&Overlay", "O"), true);
  a.outlines = checkable(made("actionOutlines", "O&utlines only", "Shift+O"), false);
  a.outlines->setIconText(tr("Outlines"));
  a.denser = made("actionDenser", "&Denser overlay", "]");
  a.fainter = made("actionFainter", "&Fainter overlay", "[");
  a.annotations = checkable(made("actionAnnotations", "&Annotations", "X"), true);
  a.crosshair = checkable(made("actionCrosshair", "&Crosshair", "Shift+X"), true);
  a.fourViews = made("actionFourViews", "Four &views", "Alt+1");
  a.sceneAlone = made("actionSceneAlone", "&3-D view alone", "Alt+4");
  return a;
}

void fillSliceMenu(QMenu& menu, const SliceActions& a) {
  for (QAction* window : a.windows) menu.addAction(window);
  menu.addSeparator();
  menu.addActions({a.overlay, a.outlines, a.denser, a.fainter});
  menu.addSeparator();
  menu.addActions({a.annotations, a.crosshair});
  menu.addSeparator();
  menu.addActions({a.fourViews, a.sceneAlone});
}

}  // namespace pneuma
