#pragma once

#include <QApplication>
#include <memory>

namespace pneuma {

/// The Qt application with the OpenGL format that the 3-D view needs; before any widget.
std::unique_ptr<QApplication> makeApplication(int& argc, char** argv);

}  // namespace pneuma
