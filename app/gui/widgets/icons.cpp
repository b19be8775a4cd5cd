#include "widgets/icons.h"

#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QSvgRenderer>

#include "widgets/theme.h"

namespace pneuma {

namespace {

void paintIcon(QPainter& painter, const QString& name, const QColor& colour, const QRectF& box) {
  QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
  if (!file.open(QIODevice::ReadOnly)) return;
  QByteArray svg = file.readAll();
  svg.replace("currentColor", colour.name().toLatin1());
  QSvgRenderer(svg).render(&painter, box);
}

class ThemedIconEngine : public QIconEngine {
 public:
  explicit ThemedIconEngine(QString name) : name_(std::move(name)) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    const Theme& theme = currentTheme();
    paintIcon(*painter, name_, mode == QIcon::Disabled ? theme.dim : theme.text, rect);
  }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap pixmap(size);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    paint(&painter, QRect(QPoint(0, 0), size), mode, state);
    return pixmap;
  }

  QIconEngine* clone() const override { return new ThemedIconEngine(name_); }

 private:
  QString name_;
};

}  // namespace

QIcon themedIcon(const char* name) { return QIcon(new ThemedIconEngine(QString::fromUtf8(name))); }

QPixmap iconPixmap(const char* name, const QColor& colour, int size, double devicePixelRatio) {
  const int pixels = static_cast<int>(size * devicePixelRatio + 0.5);
  QPixmap pixmap(pixels, pixels);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  paintIcon(painter, QString::fromUtf8(name), colour, QRectF(0, 0, pixels, pixels));
  painter.end();
  pixmap.setDevicePixelRatio(devicePixelRatio);
  return pixmap;
}

}  // namespace pneuma
