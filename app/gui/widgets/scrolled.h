#pragma once

class QScrollArea;
class QWidget;

namespace pneuma {

/// Fills a panel with content that may be taller than it: scrolls upright only, without a frame.
QScrollArea* fillScrolling(QWidget* panel, QWidget* content);

}  // namespace pneuma
