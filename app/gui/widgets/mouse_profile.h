#pragma once

#include <QString>
#include <Qt>
#include <array>

namespace pneuma {

/// Whose habits the mouse follows in slices. The wheel and double clicks are the same in all, and a
/// click moves the crosshair; in 3-D views the programs agree.
enum class MouseProfile { Usual, Slicer, Radiology };

/// What a drag does in a slice.
enum class SliceDrag { None, Crosshair, Pan, Zoom, Window, Scroll };

/// One profile for people.
struct MouseHabits {
  MouseProfile profile = MouseProfile::Usual;
  const char* name = "";   ///< for settings, objects and scripts
  const char* title = "";  ///< not yet translated
  SliceDrag left = SliceDrag::None;
  SliceDrag middle = SliceDrag::None;
  SliceDrag right = SliceDrag::None;
};

/// In the order of MouseProfile.
const std::array<MouseHabits, 3>& mouseHabits();

const MouseHabits& habitsOf(MouseProfile profile);

/// The usual one if nothing is called so.
MouseProfile mouseProfile(const QString& name);

/// Shift moves the picture with the left button, whatever that does alone.
SliceDrag sliceDrag(MouseProfile profile, Qt::MouseButton button, Qt::KeyboardModifiers modifiers);

/// In few words: "Move the picture".
QString dragText(SliceDrag drag);

}  // namespace pneuma
