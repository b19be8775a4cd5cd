#pragma once

#include <QColor>
#include <QIcon>
#include <QPixmap>

namespace pneuma {

/// An icon of resources/gui/icons drawn in the colours of the theme in use at the moment it is
/// painted, at any size.
QIcon themedIcon(const char* name);

/// The same in one colour. @param size in logical pixels
QPixmap iconPixmap(const char* name, const QColor& colour, int size, double devicePixelRatio);

}  // namespace pneuma
