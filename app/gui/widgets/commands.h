#pragma once

#include <QString>
#include <functional>
#include <vector>

#include "widgets/view_keys.h"

class QAction;
class QMenuBar;

namespace pneuma {

/// Something the window can be told to do, as the command palette offers it.
struct Command {
  QString title;
  QString group;
  QString keys;      ///< empty: none
  QString obstacle;  ///< why it cannot be done now; empty: nothing is known
  bool enabled = true;
  bool on = false;  ///< of what is on or off
  std::function<void()> run;
};

/// Lets an action be used or not.
/// @param tip what it does, while it can
/// @param obstacle why it cannot, while it cannot: its tool tip then, and what the palette says
void allow(QAction& action, bool enabled, const QString& tip, const QString& obstacle);

/// An action's or a menu's name without the mark of its letter.
QString plainText(QString text);

/// Every visible action of the menus, in their order.
std::vector<Command> commandsOf(const QMenuBar& menus);

/// The keys of every action of the menus, and after them those of the views.
std::vector<KeyRow> keyRows(const QMenuBar& menus, MouseProfile mouse);

/// Sentences on keys that mean two things in one place; none if all is well.
QStringList keyConflicts(const std::vector<KeyRow>& rows);

}  // namespace pneuma
