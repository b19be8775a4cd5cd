#include "widgets/stereo_window.h"

#include <algorithm>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>

#include "render/aside.h"

namespace pneuma {

vtkStandardNewMacro(StereoWindow);

void StereoWindow::setStereo(Scene& scene, const StereoOptions& stereo) {
  scene_ = &scene;
  stereo_ = stereo;
  // Whoever asks where something is means the left half.
  scene.setColumns(0.0, halved() ? 0.5 : 1.0);
}

bool StereoWindow::halved() const {
  return stereo_.stereo == Stereo::SideBySide || stereo_.stereo == Stereo::Crossed;
}

void StereoWindow::drawFor(double mm) {
  vtkRenderer* renderer = scene_->renderer();
  const Aside aside(*renderer->GetActiveCamera(), mm, renderer->GetTiledAspectRatio());
  Renderers->Render();
}

Picture StereoWindow::drawn() {
  const int* size = GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels.Get(), 0);
  const std::uint8_t* from = pixels->GetPointer(0);
  return {size[0], size[1], {from, from + pixels->GetNumberOfValues()}};
}

void StereoWindow::show(const Picture& picture) {
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(3);
  pixels->SetNumberOfTuples(static_cast<vtkIdType>(picture.rgb.size() / 3));
  std::ranges::copy(picture.rgb, pixels->GetPointer(0));
  SetPixelData(0, 0, picture.width - 1, picture.height - 1, pixels.Get(), 0, 0);
}

void StereoWindow::DoStereoRender() {
  if (scene_ == nullptr || stereo_.stereo == Stereo::None) {
    Superclass::DoStereoRender();
    return;
  }
  Start();
  const double half = 0.5 * stereo_.eyeDistanceMm;
  if (halved()) {
    const double left = stereo_.stereo == Stereo::SideBySide ? -half : half;
    scene_->setColumns(0.5, 1.0);
    drawFor(-left);
    scene_->setColumns(0.0, 0.5);
    drawFor(left);
    return;
  }
  // Both from the bottom to the top, as OpenGL has them.
  drawFor(-half);
  const Picture left = drawn();
  drawFor(half);
  show(stereoPicture(left, drawn(), stereo_.stereo));
}

}  // namespace pneuma
