#include "widgets/commands.h"

#include <QAction>
#include <QKeySequence>
#include <QMenu>
#include <QMenuBar>
#include <QVariant>

namespace pneuma {

namespace {

constexpr const char* ObstacleProperty = "obstacle";

/// Calls visit(menu's name, action) for everything that menus hold.
template <class Visit>
void visitActions(const QList<QAction*>& actions, const QString& group, const Visit& visit) {
  for (QAction* action : actions) {
    if (action->isSeparator()) continue;
    if (action->menu() != nullptr) {
      visitActions(action->menu()->actions(), plainText(action->menu()->title()), visit);
    } else {
      visit(group, *action);
    }
  }
}

QStringList keysOf(const QAction& action) {
  QStringList keys;
  for (const QKeySequence& key : action.shortcuts()) {
    keys << key.toString(QKeySequence::NativeText);
  }
  return keys;
}

KeyPlace placeOf(const QAction& action) {
  switch (action.shortcutContext()) {
    case Qt::WidgetShortcut:
      return KeyPlace::Slices;
    case Qt::WidgetWithChildrenShortcut:
      return KeyPlace::Views;
    default:
      return KeyPlace::Window;
  }
}

/// True if something may have the focus where both act.
bool meet(KeyPlace a, KeyPlace b) {
  if (a == KeyPlace::Mouse || b == KeyPlace::Mouse) return false;
  if (a == b || a == KeyPlace::Window || b == KeyPlace::Window) return true;
  const auto views = [](KeyPlace one, KeyPlace other) {
    return one == KeyPlace::Views && (other == KeyPlace::Slices || other == KeyPlace::Scene);
  };
  return views(a, b) || views(b, a);
}

}  // namespace

void allow(QAction& action, bool enabled, const QString& tip, const QString& obstacle) {
  action.setEnabled(enabled);
  action.setToolTip(enabled || obstacle.isEmpty() ? tip : obstacle);
  action.setProperty(ObstacleProperty, enabled ? QString() : obstacle);
}

QString plainText(QString text) {
  text.replace(QStringLiteral("&&"), QStringLiteral("\n"));
  text.remove(QLatin1Char('&'));
  return text.replace(QLatin1Char('\n'), QLatin1Char('&'));
}

std::vector<Command> commandsOf(const QMenuBar& menus) {
  std::vector<Command> commands;
  visitActions(menus.actions(), {}, [&](const QString& group, QAction& action) {
    if (!action.isVisible()) return;
    commands.push_back({plainText(action.text()), group, keysOf(action).join(QStringLiteral("  ")),
                        action.property(ObstacleProperty).toString(), action.isEnabled(),
                        action.isCheckable() && action.isChecked(),
                        [&action] { action.trigger(); }});
  });
  return commands;
}

std::vector<KeyRow> keyRows(const QMenuBar& menus, MouseProfile mouse) {
  std::vector<KeyRow> rows;
  visitActions(menus.actions(), {}, [&](const QString& group, const QAction& action) {
    if (!action.isVisible() || action.shortcuts().isEmpty()) return;
    rows.push_back({group, plainText(action.text()), keysOf(action), placeOf(action)});
  });
  const std::vector<KeyRow> views = viewKeyRows(mouse);
  rows.insert(rows.end(), views.begin(), views.end());
  return rows;
}

QStringList keyConflicts(const std::vector<KeyRow>& rows) {
  QStringList conflicts;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      if (!meet(rows[i].place, rows[j].place)) continue;
      for (const QString& key : rows[i].keys) {
        if (!rows[j].keys.contains(key)) continue;
        conflicts << QStringLiteral("%1: %2; %3").arg(key, rows[i].what, rows[j].what);
      }
    }
  }
  return conflicts;
}

}  // namespace pneuma
