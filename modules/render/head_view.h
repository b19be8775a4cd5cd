#pragma once

#include <memory>

#include "core/math.h"
#include "render/picture.h"
#include "render/stereo.h"

namespace pneuma {

/// What a head sees of a scene as it moves: pictures one after the other in one window that nobody
/// sees, in the size that is asked for and not averaged from a larger one, as a display draws them.
/// The scene is in that window as long as this lives; its camera stays where the last head was.
class HeadView {
 public:
  /// @param width, height in pixels, 16 .. 8192, of both eyes together
  /// @throws as renderStereo()
  HeadView(Scene& scene, int width, int height, const StereoOptions& stereo);
  ~HeadView();
  HeadView(const HeadView&) = delete;
  HeadView& operator=(const HeadView&) = delete;

  /// @param position midway between the eyes, LPS, mm
  /// @param orientation of unit length, turns the head's axes (x to its right, y up, z backwards)
  /// into LPS
  /// The picture is 22 degrees high, as all are. For two eyes the plane of the screen is as deep as
  /// the middle of what the scene shows, but 50 mm away at least.
  /// @throws NoRendering
  Picture from(const Vec3& position, const Eigen::Quaterniond& orientation);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pneuma
