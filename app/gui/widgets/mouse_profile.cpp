#include "widgets/mouse_profile.h"

#include <QObject>

namespace pneuma {

const std::array<MouseHabits, 3>& mouseHabits() {
  using enum SliceDrag;
  static constexpr std::array<MouseHabits, 3> habits = {{
      {MouseProfile::Usual, "usual", QT_TR_NOOP("Usual, as in ITK-SNAP"), Crosshair, Pan, Zoom},
      {MouseProfile::Slicer, "slicer", QT_TR_NOOP("As in 3D Slicer"), Window, Pan, Zoom},
      {MouseProfile::Radiology, "radiology", QT_TR_NOOP("As on a radiology workstation"), Scroll,
       Pan, Window},
  }};
  return habits;
}

const MouseHabits& habitsOf(MouseProfile profile) {
  return mouseHabits()[static_cast<std::size_t>(profile)];
}

MouseProfile mouseProfile(const QString& name) {
  for (const MouseHabits& habits : mouseHabits()) {
    if (name == QLatin1String(habits.name)) return habits.profile;
  }
  return MouseProfile::Usual;
}

SliceDrag sliceDrag(MouseProfile profile, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
  const MouseHabits& habits = habitsOf(profile);
  switch (button) {
    case Qt::LeftButton:
      return modifiers.testFlag(Qt::ShiftModifier) ? SliceDrag::Pan : habits.left;
    case Qt::MiddleButton:
      return habits.middle;
    case Qt::RightButton:
      return habits.right;
    default:
      return SliceDrag::None;
  }
}

QString dragText(SliceDrag drag) {
  switch (drag) {
    case SliceDrag::Crosshair:
      return QObject::tr("Move the crosshair");
    case SliceDrag::Pan:
      return QObject::tr("Move the picture");
    case SliceDrag::Zoom:
      return QObject::tr("Zoom");
    case SliceDrag::Window:
      return QObject::tr("Window and level of the grey");
    case SliceDrag::Scroll:
      return QObject::tr("Go through the slices");
    case SliceDrag::None:
      break;
  }
  return {};
}

}  // namespace pneuma
