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
constexpr double MarkReachPixels = 9.0;
constexpr int PixelsPerSlice = 4;
constexpr int StillPixels = 4;    ///< a press that moves less is a click
constexpr int BrushShadow = 140;  ///< of a circle on a bright ground, of 255

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
    drawn_ = {};
    if (views_.empty()) return;
    setAccessibleDescription(
        qtText(positionText(normalAxis(plane_), views_.point()[normalAxis(plane_)])));
    update();
  });
}

void SliceView::setEditor(FissureEditor* editor) {
  if (editor_ != nullptr) editor_->disconnect(this);
  editor_ = editor;
  drag_ = Drag::None;
  if (editor_ != nullptr) connect(editor_, &FissureEditor::changed, this, &SliceView::showCursor);
  showCursor();
}

void SliceView::setLungEditor(LungEditor* editor) {
  if (lungEditor_ != nullptr) lungEditor_->disconnect(this);
  lungEditor_ = editor;
  drag_ = Drag::None;
  if (lungEditor_ != nullptr) {
    connect(lungEditor_, &LungEditor::changed, this, &SliceView::showCursor);
  }
  showCursor();
}

void SliceView::showCursor() {
  const bool seed = lungEditor_ != nullptr && lungEditor_->tool() == LungEditor::Tool::Seed;
  const bool placing = editor_ != nullptr && editor_->placing();
  setCursor(seed || placing ? Qt::PointingHandCursor : Qt::CrossCursor);
  update();  // the circle
}

void SliceView::drawBrush(QPainter& painter) const {
  if (lungEditor_ == nullptr || !lungEditor_->brushing() || !pointer_) return;
  const double radius = lungEditor_->radiusMm() / frame().mmPerPixel / devicePixelRatioF();
  const QPointF centre = QPointF(*pointer_) + QPointF(0.5, 0.5);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, BrushShadow), 3.0));
  painter.drawEllipse(centre, radius, radius);
  const bool erases = lungEditor_->tool() == LungEditor::Tool::Eraser;
  painter.setPen(QPen(Qt::white, 1.4, erases ? Qt::DashLine : Qt::SolidLine));
  painter.drawEllipse(centre, radius, radius);
  painter.setRenderHint(QPainter::Antialiasing, false);
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
  const SliceFrame shown = frame();
  if (drawn_.isNull() || drawn_.width() != shown.width || drawn_.height() != shown.height) {
    drawn_ = picture();
    drawn_.setDevicePixelRatio(devicePixelRatioF());
  }
  painter.drawImage(0, 0, drawn_);
  drawBrush(painter);
  if (hasFocus()) {
    painter.setPen(currentTheme().accent);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
}

void SliceView::mousePressEvent(QMouseEvent* event) {
  if (views_.empty()) return;
  before_ = event->pos();
  pressed_.reset();
  if (editor_ != nullptr && pressFissure(*event)) return;
  if (lungEditor_ != nullptr && pressLungs(*event)) return;
  zoomedAbout_ = onPicture(event->pos());
  scrollRest_ = 0;
  drag_ = dragOf(*event);
  if (drag_ == Drag::Point) {
    views_.moveTo(frame().pointAt(onPicture(event->pos())));
  } else if (event->button() == Qt::LeftButton && event->modifiers() == Qt::NoModifier &&
             !windowKey_) {
    pressed_ = event->pos();
  }
}

SliceView::Drag SliceView::dragOf(const QMouseEvent& event) const {
  if (windowKey_ && event.button() == Qt::LeftButton) return Drag::Window;
  switch (sliceDrag(mouse_, event.button(), event.modifiers())) {
    case SliceDrag::Crosshair:
      return Drag::Point;
    case SliceDrag::Pan:
      return Drag::Pan;
    case SliceDrag::Zoom:
      return Drag::Zoom;
    case SliceDrag::Window:
      return Drag::Window;
    case SliceDrag::Scroll:
      return Drag::Scroll;
    case SliceDrag::None:
      break;
  }
  return Drag::None;
}

std::optional<FissureEditor::Mark> SliceView::markAt(const QPoint& position) const {
  const SliceFrame shown = frame();
  return editor_->markAt(shown.pointAt(onPicture(position)), normalAxis(plane_),
                         MarkReachPixels * devicePixelRatioF() * shown.mmPerPixel);
}

bool SliceView::pressFissure(const QMouseEvent& event) {
  if (windowKey_ || event.modifiers() != Qt::NoModifier) return false;
  const auto mark = markAt(event.pos());
  if (event.button() == Qt::RightButton) {
    if (!mark) return false;
    editor_->removePoint(mark->fissure, mark->index);
    drag_ = Drag::None;
    return true;
  }
  if (event.button() != Qt::LeftButton) return false;
  if (mark) {
    mark_ = *mark;
    editor_->setCurrent(mark->fissure);
    drag_ = Drag::Mark;
    return true;
  }
  // A plane has its handles, and takes no points.
  const bool takesPoints = editor_->edit(editor_->current()).method == FissureMethod::Points;
  if (!editor_->placing() || !takesPoints) return false;
  const Vec3 point = frame().pointAt(onPicture(event.pos()));
  editor_->addPoint(point);
  // A press that goes on moves the point that it set.
  const std::size_t count = editor_->edit(editor_->current()).points.size();
  drag_ = count > 0 ? Drag::Mark : Drag::None;
  if (count > 0) mark_ = {editor_->current(), count - 1, point};
  return true;
}

bool SliceView::pressLungs(const QMouseEvent& event) {
  if (lungEditor_->tool() == LungEditor::Tool::None || windowKey_ ||
      event.modifiers() != Qt::NoModifier || event.button() != Qt::LeftButton) {
    return false;
  }
  lungEditor_->press(plane_, frame().pointAt(onPicture(event.pos())));
  drag_ = lungEditor_->stroking() ? Drag::Stroke : Drag::None;
  return true;
}

void SliceView::mouseMoveEvent(QMouseEvent* event) {
  if (views_.empty()) return;
  pointer_ = event->pos();
  if (lungEditor_ != nullptr && lungEditor_->brushing()) update();
  emit hovered(frame().pointAt(onPicture(event->pos())));
  if (event->buttons() == Qt::NoButton) {
    if (event->modifiers().testFlag(Qt::ShiftModifier)) {
      views_.moveTo(frame().pointAt(onPicture(event->pos())));
    }
    return;
  }
  if (pressed_) {
    if ((event->pos() - *pressed_).manhattanLength() < StillPixels) return;
    pressed_.reset();
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
    case Drag::Scroll: {
      scrollRest_ -= moved.y();
      const int slices = scrollRest_ / PixelsPerSlice;
      scrollRest_ -= slices * PixelsPerSlice;
      if (slices != 0) views_.step(plane_, slices);
      break;
    }
    case Drag::Mark:
      if (editor_ != nullptr) editor_->drag(mark_, shown.pointAt(onPicture(position)));
      break;
    case Drag::Stroke:
      if (lungEditor_ != nullptr) lungEditor_->drag(shown.pointAt(onPicture(position)));
      break;
    case Drag::None:
      break;
  }
}

void SliceView::mouseReleaseEvent(QMouseEvent*) {
  if (drag_ == Drag::Mark && editor_ != nullptr) editor_->release();
  if (drag_ == Drag::Stroke && lungEditor_ != nullptr) lungEditor_->release();
  if (pressed_ && !views_.empty()) views_.moveTo(frame().pointAt(onPicture(*pressed_)));
  pressed_.reset();
  drag_ = Drag::None;
}

void SliceView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (editor_ != nullptr && editor_->placing()) {
    mousePressEvent(event);  // two clicks soon after one another
    return;
  }
  if (lungEditor_ != nullptr && lungEditor_->tool() != LungEditor::Tool::None) {
    mousePressEvent(event);
    return;
  }
  drag_ = Drag::None;
  pressed_.reset();
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
  const auto does = sliceKey(event->key());
  if (does && act(*does)) return;
  QWidget::keyPressEvent(event);
}

bool SliceView::act(SliceKey does) {
  switch (does) {
    case SliceKey::Next:
      views_.step(plane_, 1);
      return true;
    case SliceKey::Previous:
      views_.step(plane_, -1);
      return true;
    case SliceKey::NextPage:
      views_.step(plane_, PageSlices);
      return true;
    case SliceKey::PreviousPage:
      views_.step(plane_, -PageSlices);
      return true;
    case SliceKey::ResetFrame:
      views_.resetFrame(plane_);
      return true;
    case SliceKey::HoldForWindow:
      windowKey_ = true;
      return true;
    default:
      return editor_ != nullptr && actOnFissures(does);
  }
}

bool SliceView::actOnFissures(SliceKey does) {
  switch (does) {
    case SliceKey::RemoveLastPoint:
      editor_->removeLast();
      return true;
    case SliceKey::DeletePoint:
      if (const auto mark = markAt(mapFromGlobal(QCursor::pos()))) {
        editor_->removePoint(mark->fissure, mark->index);
      }
      return true;
    case SliceKey::NextFissure:
    case SliceKey::PreviousFissure:
      editor_->step(does == SliceKey::NextFissure ? 1 : -1);
      return true;
    default:
      return false;
  }
}

bool SliceView::focusNextPrevChild(bool next) {
  if (editor_ != nullptr && editor_->placing()) return false;
  return QWidget::focusNextPrevChild(next);
}

void SliceView::keyReleaseEvent(QKeyEvent* event) {
  if (sliceKey(event->key()) == SliceKey::HoldForWindow && !event->isAutoRepeat()) {
    windowKey_ = false;
  }
  QWidget::keyReleaseEvent(event);
}

void SliceView::leaveEvent(QEvent*) {
  windowKey_ = false;
  pointer_.reset();
  if (lungEditor_ != nullptr && lungEditor_->brushing()) update();
  emit hovered(std::nullopt);
}

}  // namespace pneuma
