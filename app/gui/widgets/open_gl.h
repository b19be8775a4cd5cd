#pragma once

#include <QString>

namespace pneuma {

/// Why nothing can be drawn in three dimensions here, and what to do about it; empty if it can:
/// VTK needs OpenGL 3.2. Asked of the graphics once; needs the application object.
const QString& openGlObstacle();

}  // namespace pneuma
