#include "widgets/open_gl.h"

#include <QObject>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QPair>
#include <QSurfaceFormat>

namespace pneuma {

namespace {

const QPair<int, int> NeededVersion(3, 2);

QString askGraphics() {
  const QString advice = QObject::tr(
      "Slices, lungs, lobes, airways and export work without it. Update the graphics driver, or "
      "start the program with LIBGL_ALWAYS_SOFTWARE=1.");
  QOpenGLContext context;
  context.setFormat(QSurfaceFormat::defaultFormat());
  QOffscreenSurface surface;
  surface.setFormat(QSurfaceFormat::defaultFormat());
  if (context.create()) {
    surface.setFormat(context.format());
    surface.create();
  }
  if (!context.isValid() || !context.makeCurrent(&surface)) {
    return QObject::tr("The 3-D view needs OpenGL 3.2, and there is none here. %1").arg(advice);
  }
  const QPair<int, int> version = context.format().version();
  context.doneCurrent();
  if (version >= NeededVersion) return {};
  return QObject::tr(
             "The 3-D view needs OpenGL 3.2; the graphics here offer no more than %1.%2. %3")
      .arg(version.first)
      .arg(version.second)
      .arg(advice);
}

}  // namespace

const QString& openGlObstacle() {
  static const QString obstacle = askGraphics();
  return obstacle;
}

}  // namespace pneuma
