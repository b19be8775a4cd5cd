#pragma once

#include <span>
#include <string>

#include "core/math.h"
#include "render/scene.h"

namespace pneuma {

/// The directions of a picture in patient space, unit vectors, LPS.
struct ViewAxes {
  Vec3 right;       ///< to the picture's right
  Vec3 up;          ///< to its top
  Vec3 towardsEye;  ///< out of the picture
};

ViewAxes axesOf(ViewDirection direction);

/// The direction from which a camera looks, given the unit vector from what it sees to its eye.
ViewDirection viewDirectionOf(const Vec3& towardsEye, const Vec3& up);

/// "L", "RA" ...: the patient's side that a unit vector points to, at most two letters.
std::string orientationLetters(const Vec3& direction);

/// The part of a picture that is left for the organ, in pixels from each edge.
struct Insets {
  double left = 0.0;
  double right = 0.0;
  double bottom = 0.0;
  double top = 0.0;
};

/// Where a camera stands. Perspective.
struct CameraPose {
  Vec3 eye = Vec3(0.0, -1000.0, 0.0);
  Vec3 focus = Vec3::Zero();
  Vec3 up = Vec3::UnitZ();
};

inline constexpr double ViewAngleDeg = 22.0;  ///< of the picture's height

/// The nearest pose from which every point lies within the insets, centred between them.
/// The focus lies at the depth of the points' middle.
CameraPose framed(std::span<const Vec3> points, ViewDirection direction, int width, int height,
                  const Insets& insets);

}  // namespace pneuma
