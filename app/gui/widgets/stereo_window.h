#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

#include "render/stereo.h"

namespace pneuma {

/// The OpenGL window of the 3-D view, which draws its scene for one eye or for two as
/// renderStereo() does: side by side in its halves, or as an anaglyph.
class StereoWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static StereoWindow* New();
  vtkTypeMacro(StereoWindow, vtkGenericOpenGLRenderWindow);

  /// @param scene in this window; outlives what is drawn for two eyes
  void setStereo(Scene& scene, const StereoOptions& stereo);

  const StereoOptions& stereo() const { return stereo_; }

  /// True if each eye has a half of the window.
  bool halved() const;

 protected:
  StereoWindow() = default;

  void DoStereoRender() override;

 private:
  /// What an eye sees, drawn into this window. @param mm to the right
  void drawFor(double mm);
  Picture drawn();
  void show(const Picture& picture);

  Scene* scene_ = nullptr;
  StereoOptions stereo_;
};

}  // namespace pneuma
