#pragma once

#include <QPushButton>

class QAction;

namespace pneuma {

struct Actions;

/// A push button that does what an action does and is enabled when the action is. Its tool tip is
/// the action's, with the key.
/// @param role "primary", "quiet" or null, see style.qss
QPushButton* actionButton(QAction* action, const char* name, const char* role = nullptr);

/// The same by the action's short name (its iconText), pressed while the action is on.
QPushButton* shortButton(QAction* action, const char* name, const char* role = nullptr);

/// A push button that opens the menu of the built-in organs.
QPushButton* organButton(const Actions& actions, const char* name);

}  // namespace pneuma
