#include "widgets/slice_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

#include "document/text.h"
#include "widgets/theme.h"

namespace pneuma {

namespace {

constexpr int WheelNotch = 120;
constexpr int FastSlices = 5;
constexpr int PageSlices = 10;
constexpr double ZoomPerNotch = 1.2;
constexpr double ZoomPerPixel = 1.008;
constexpr double HuPerPixel = 4.0;

}  // namespace

SliceView::SliceView(SliceViews& views, SlicePlane plane, QWidget* parent)
    : QWidget(parent), views_(views), plane_(plane) {
  const QString name = qtText(choices(SlicePlane{})[static_cast<std::size_t>(plane)]);
  setObjectName(QStringLiteral("slice_") + name);
  setAccessibleName(tr("%1 slice of the CT").arg(capitalised(name.toStdString())));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(120, 100);
  setCursor(Qt::CrossCursor);
  connect(&views_, &SliceViews::changed, this, [this] {
    if (views_.empty()) return;
    setAccessibleDescription(
        qtText(positionText(normalAxis(plane_), views_.point()[normalAxis(plane_)])));
    update();
  });
}

SliceFrame SliceView::frame() const {
  const double ratio = devicePixelRatioF();
  return views_.frame(plane_, std::max(1, static_cast<int>(std::lround(width() * ratio))),
                      std::max(1, static_cast<int>(std::lround(height() * ratio))));
}

PicturePoint SliceView::onPicture(const QPointF& position) const {
  const double ratio = devicePixelRatioF();
  return {(position.x() + 0.5) * ratio, (position.y() + 0.5) * ratio};
}

QPoint SliceView::positionOf(const Vec3& point) const {
  const PicturePoint drawn = frame().drawnAt(point);
  const double ratio = devicePixelRatioF();
  return {static_cast<int>(std::floor(drawn.x / ratio)),
          static_cast<int>(std::floor(drawn.y / ratio))};
}

QImage SliceView::picture() const {
  const SliceFrame shown = frame();
  const Picture picture = views_.picture(plane_, shown.width, shown.height, devicePixelRatioF());
  return QImage(picture.rgb.data(), picture.width, picture.height, 3 * picture.width,
                QImage::Format_RGB888)
      .convertToFormat(QImage::Format_RGB32);
}

void SliceView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (views_.empty()) {
    painter.fillRect(rect(), Qt::black);
    return;
  }
  QImage image = picture();
  image.setDevicePixelRatio(devicePixelRatioF());
  painter.drawImage(0, 0, image);
  if (hasFocus()) {
    painter.setPen(currentTheme().accent);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
}

void SliceView::mousePressEvent(QMouseEvent* event) {
  if (views_.empty()) return;
  before_ = event->pos();
  zoomedAbout_ = onPicture(event->pos());
  const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
  switch (event->button()) {
    case Qt::LeftButton:
      drag_ = windowKey_ ? Drag::Window : shift ? Drag::Pan : Drag::Point;
      break;
    case Qt::MiddleButton:
      drag_ = Drag::Pan;
      break;
    case Qt::RightButton:
      drag_ = Drag::Zoom;
      break;
    default:
      drag_ = Drag::None;
  }
  if (drag_ == Drag::Point) views_.moveTo(frame().pointAt(onPicture(event->pos())));
}

void SliceView::mouseMoveEvent(QMouseEvent* event) {
  if (views_.empty()) return;
  emit hovered(frame().pointAt(onPicture(event->pos())));
  if (event->buttons() == Qt::NoButton) {
    if (event->modifiers().testFlag(Qt::ShiftModifier)) {
      views_.moveTo(frame().pointAt(onPicture(event->pos())));
    }
    return;
  }
  dragTo(event->pos());
  before_ = event->pos();
}

void SliceView::dragTo(const QPoint& position) {
  const QPoint moved = position - before_;
  SliceFrame shown = frame();
  switch (drag_) {
    case Drag::Point:
      views_.moveTo(shown.pointAt(onPicture(position)));
      break;
    case Drag::Pan:
      shown.centre += shown.pointAt(onPicture(before_)) - shown.pointAt(onPicture(position));
      views_.setFrame(shown);
      break;
    case Drag::Zoom:
      views_.setFrame(zoomed(shown, zoomedAbout_, std::pow(ZoomPerPixel, -moved.y())));
      break;
    case Drag::Window: {
      SliceLook look = views_.look();
      look.window.widthHu = std::clamp(look.window.widthHu + HuPerPixel * moved.x(),
                                       NarrowestWindowHu, WidestWindowHu);
      look.window.levelHu =
          std::clamp(look.window.levelHu + HuPerPixel * moved.y(), -WidestWindowHu, WidestWindowHu);
      views_.setLook(look);
      break;
    }
    case Drag::None:
      break;
  }
}

void SliceView::mouseReleaseEvent(QMouseEvent*) { drag_ = Drag::None; }

void SliceView::mouseDoubleClickEvent(QMouseEvent* event) {
  drag_ = Drag::None;
  if (event->button() == Qt::LeftButton) emit doubleClicked(plane_);
}

void SliceView::wheelEvent(QWheelEvent* event) {
  if (views_.empty()) return;
  // With Alt or Shift some systems turn the wheel sideways.
  const int turned = event->angleDelta().y() + event->angleDelta().x();
  if (event->modifiers().testFlag(Qt::ControlModifier)) {
    const double notches = static_cast<double>(turned) / WheelNotch;
    views_.setFrame(zoomed(frame(), onPicture(event->position()), std::pow(ZoomPerNotch, notches)));
  } else {
    wheelRest_ += turned;
    const int notches = wheelRest_ / WheelNotch;
    wheelRest_ -= notches * WheelNotch;
    const bool fast = event->modifiers().testFlag(Qt::ShiftModifier);
    views_.step(plane_, notches * (fast ? FastSlices : 1));
  }
  event->accept();
}

void SliceView::keyPressEvent(QKeyEvent* event) {
  if (views_.empty() || (event->modifiers() & (Qt::ControlModifier | Qt::AltModifier))) {
    QWidget::keyPressEvent(event);
    return;
  }
  switch (event->key()) {
    case Qt::Key_Up:
    case Qt::Key_F:
      views_.step(plane_, 1);
      break;
    case Qt::Key_Down:
    case Qt::Key_B:
      views_.step(plane_, -1);
      break;
    case Qt::Key_PageUp:
      views_.step(plane_, PageSlices);
      break;
    case Qt::Key_PageDown:
      views_.step(plane_, -PageSlices);
      break;
    case Qt::Key_R:
      views_.resetFrame(plane_);
      break;
    case Qt::Key_W:
      windowKey_ = true;
      break;
    default:
      QWidget::keyPressEvent(event);
  }
}

void SliceView::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_W && !event->isAutoRepeat()) windowKey_ = false;
  QWidget::keyReleaseEvent(event);
}

void SliceView::leaveEvent(QEvent*) {
  windowKey_ = false;
  emit hovered(std::nullopt);
}

}  // namespace pneuma
