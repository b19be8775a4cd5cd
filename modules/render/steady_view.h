#pragma once

#include <memory>

#include "render/picture.h"

namespace pneuma {

/// Pictures of a scene one after the other, as renderPicture() draws them, in one window that
/// nobody sees: what stays the same goes to the graphics card once. The scene is in that window as
/// long as this lives.
class SteadyView {
 public:
  /// @param width, height in pixels, 16 .. 8192
  /// @throws as renderPicture()
  SteadyView(Scene& scene, int width, int height);
  ~SteadyView();
  SteadyView(const SteadyView&) = delete;
  SteadyView& operator=(const SteadyView&) = delete;

  /// The scene as it is now. @throws NoRendering
  Picture draw();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pneuma
