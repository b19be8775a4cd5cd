// Draws the program's icon in the sizes that desktops ask for, at build time:
//   render_icons ICON.svg FOLDER    writes FOLDER/<size>.png
#include <QImage>
#include <QPainter>
#include <QSvgRenderer>
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  QSvgRenderer icon(QString::fromLocal8Bit(argv[1]));
  if (!icon.isValid()) {
    std::fprintf(stderr, "render_icons: %s cannot be read\n", argv[1]);
    return 3;
  }
  for (const int size : {16, 22, 24, 32, 48, 64, 128, 256, 512}) {
    QImage picture(size, size, QImage::Format_ARGB32_Premultiplied);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    icon.render(&painter);
    painter.end();
    if (!picture.save(QStringLiteral("%1/%2.png").arg(QString::fromLocal8Bit(argv[2])).arg(size))) {
      std::fprintf(stderr, "render_icons: cannot write into %s\n", argv[2]);
      return 6;
    }
  }
  return 0;
}
