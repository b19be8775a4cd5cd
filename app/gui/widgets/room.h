#pragma once

#include <initializer_list>

class QWidget;

namespace pneuma {

/// Hides parts of a bar while it is narrower than `width`, logical pixels: what is left stays
/// whole.
void hideWhenNarrow(QWidget* bar, std::initializer_list<QWidget*> parts, int width);

}  // namespace pneuma
