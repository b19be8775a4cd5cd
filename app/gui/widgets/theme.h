#pragma once

#include <QColor>

class QApplication;

namespace pneuma {

enum class ThemeName { Dark, Light };

/// The colours of one look; style.qss names them, painted widgets read them.
struct Theme {
  ThemeName name = ThemeName::Dark;
  QColor ground, panel, card, line, field, text, dim;
  QColor accent, accentHover, onAccent, selection, knob;
  QColor good;  ///< a check that holds
  QColor look;  ///< something a person should look at
};

/// The theme in use; dark until applyTheme() says otherwise.
const Theme& currentTheme();

/// Colours, style sheet, palette and font (Inter where it is installed) of the whole application.
void applyTheme(QApplication& application, ThemeName name);

}  // namespace pneuma
