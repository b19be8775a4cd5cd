#pragma once

#include <QPushButton>

class QAction;

namespace pneuma {

/// A push button that does what an action does and is enabled when the action is. Its tool tip is
/// the action's, with the key.
/// @param role "primary", "quiet" or null, see style.qss
QPushButton* actionButton(QAction* action, const char* name, const char* role = nullptr);

}  // namespace pneuma
