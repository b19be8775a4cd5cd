#include <QKeyEvent>
#include <QMouseEvent>

#include "widgets/scene_view.h"
#include "widgets/view_keys.h"

// What mouse and keys do in the 3-D view.
namespace pneuma {

namespace {

constexpr int ClickPixels = 4;  ///< a press that moves less is a click
constexpr double TurnDeg = 15.0;

}  // namespace

bool SceneView::mouseOnMark(QEvent& event) {
  if (event.type() != QEvent::MouseButtonPress && event.type() != QEvent::MouseMove &&
      event.type() != QEvent::MouseButtonRelease) {
    return false;
  }
  const auto& mouse = static_cast<QMouseEvent&>(event);
  const QPointF at = onWindow(mouse.pos());
  if (event.type() == QEvent::MouseButtonPress) {
    if (mouse.button() != Qt::LeftButton || mouse.modifiers() != Qt::NoModifier) return false;
    mark_ = scene_->markAt(at.x(), at.y());
    if (mark_) markPlace_ = scene_->markPlace(*mark_);
    return mark_.has_value();
  }
  if (!mark_) return false;
  if (event.type() == QEvent::MouseButtonRelease) {
    mark_.reset();
    emit markReleased();
    return true;
  }
  std::optional<Vec3> to;
  if (placing_) to = scene_->lungPointAt(at.x(), at.y());
  if (!to) to = scene_->pointBeside(at.x(), at.y(), markPlace_);
  emit markDragged(*mark_, *to);
  return true;
}

bool SceneView::keyPressed(int key, Qt::KeyboardModifiers modifiers) {
  if (modifiers & (Qt::ControlModifier | Qt::AltModifier)) return false;
  const auto does = sceneKey(key, modifiers);
  if (!does) return false;
  switch (*does) {
    case SceneKey::Look: {
      const char letter = static_cast<char>('A' + (key - Qt::Key_A));
      look(viewDirection(std::string_view(&letter, 1)));
      break;
    }
    case SceneKey::FrameEverything:
      resetView();
      break;
    case SceneKey::Play:
      emit playToggled();
      break;
    case SceneKey::NextFrame:
      emit stepped(1);
      break;
    case SceneKey::PreviousFrame:
      emit stepped(-1);
      break;
    case SceneKey::Mother:
      emit walked(Neighbour::Parent);
      break;
    case SceneKey::Daughter:
      emit walked(Neighbour::Child);
      break;
    case SceneKey::PreviousSister:
      emit walked(Neighbour::PreviousSibling);
      break;
    case SceneKey::NextSister:
      emit walked(Neighbour::NextSibling);
      break;
    case SceneKey::TurnLeft:
      turn(-TurnDeg, 0.0);
      break;
    case SceneKey::TurnRight:
      turn(TurnDeg, 0.0);
      break;
    case SceneKey::TurnUp:
      turn(0.0, TurnDeg);
      break;
    case SceneKey::TurnDown:
      turn(0.0, -TurnDeg);
      break;
  }
  return true;
}

void SceneView::clickedAt(const QPoint& position) {
  const QPointF at = onWindow(position);
  if (placing_) {
    if (const auto point = scene_->lungPointAt(at.x(), at.y())) {
      emit lungClicked(*point);
      return;
    }
  }
  if (picking_) {
    if (const auto hit = scene_->surfaceAt(at.x(), at.y())) {
      emit surfaceClicked(hit->surface, hit->place);
      return;
    }
  }
  emit clicked(branchAt(position));
}

bool SceneView::eventFilter(QObject* watched, QEvent* event) {
  if (watched != canvas_ || gl_ == nullptr) return QWidget::eventFilter(watched, event);
  if (mouseOnMark(*event)) return true;
  switch (event->type()) {
    case QEvent::KeyPress: {
      const auto* key = static_cast<QKeyEvent*>(event);
      return keyPressed(key->key(), key->modifiers());
    }
    case QEvent::MouseButtonPress:
      pressedAt_ = static_cast<QMouseEvent*>(event)->pos();
      settleTimer_.stop();
      break;
    case QEvent::MouseMove: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      pointer_ = mouse->pos();
      if (mouse->buttons() == Qt::NoButton) {
        hoverTimer_.start();
      } else if ((mouse->pos() - pressedAt_).manhattanLength() > ClickPixels) {
        hoverTimer_.stop();
        dragging(true);
      }
      break;
    }
    case QEvent::MouseButtonRelease: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      settleTimer_.start();
      if (mouse->button() == Qt::LeftButton &&
          (mouse->pos() - pressedAt_).manhattanLength() <= ClickPixels) {
        clickedAt(mouse->pos());
      }
      break;
    }
    case QEvent::Wheel:
      dragging(true);
      settleTimer_.start();
      break;
    case QEvent::Leave:
      hoverTimer_.stop();
      emit hovered(std::nullopt);
      break;
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace pneuma
