#include "widgets/application.h"

#include <QLocale>
#include <QSurfaceFormat>
#include <clocale>

#include <QVTKOpenGLNativeWidget.h>

namespace pneuma {

std::unique_ptr<QApplication> makeApplication(int& argc, char** argv) {
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);
  QSurfaceFormat::setDefaultFormat(format);
#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
#endif
  auto application = std::make_unique<QApplication>(argc, argv);
  // Qt takes on the user's locale: files would be read and written with decimal commas. What is
  // shown is in English.
  std::setlocale(LC_NUMERIC, "C");
  QLocale::setDefault(QLocale(QLocale::English, QLocale::UnitedStates));
  QApplication::setOrganizationName(QStringLiteral("pneuma"));
  QApplication::setApplicationName(QStringLiteral("pneuma-desktop"));
  return application;
}

}  // namespace pneuma
