#include "render/lighting.h"

#include <vtkCameraPass.h>
#include <vtkLight.h>
#include <vtkLightsPass.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkOverlayPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkTranslucentPass.h>

#include "render/colour.h"

namespace pneuma {
namespace {

void addLight(vtkRenderer* renderer, const Vec3& from, double intensity, const Rgb& colour) {
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(from.x(), from.y(), from.z());
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetIntensity(intensity);
  light->SetColor(colour.r, colour.g, colour.b);
  renderer->AddLight(light);
}

}  // namespace

void addLights(vtkRenderer* renderer) {
  renderer->AutomaticLightCreationOff();
  addLight(renderer, Vec3(-0.6, 0.8, 1.0), 0.85, {1.0, 0.97, 0.92});
  addLight(renderer, Vec3(1.0, 0.2, 0.8), 0.30, {0.85, 0.92, 1.0});
  addLight(renderer, Vec3(0.0, -1.0, 0.5), 0.18, {1.0, 1.0, 1.0});
}

vtkSmartPointer<vtkRenderPass> addPasses(vtkRenderer* renderer) {
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkTranslucentPass> translucent;
  vtkNew<vtkOverlayPass> overlay;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(lights);
  passes->AddItem(opaque);
  passes->AddItem(translucent);
  passes->AddItem(overlay);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  // vtkRenderer::UseFXAA is ignored once passes are set.
  auto smooth = vtkSmartPointer<vtkOpenGLFXAAPass>::New();
  smooth->SetDelegatePass(camera);
  renderer->SetPass(smooth);
  return smooth;
}

void setSmooth(vtkRenderer* renderer, vtkRenderPass* passes, bool smooth) {
  auto* smoothing = vtkOpenGLFXAAPass::SafeDownCast(passes);
  renderer->SetPass(smooth || smoothing == nullptr ? passes : smoothing->GetDelegatePass());
}

void setBackground(vtkRenderer* renderer, Background background) {
  const auto ground = [&](std::uint32_t bottom, std::uint32_t top) {
    const Rgb low = rgbOfHex(bottom);
    const Rgb high = rgbOfHex(top);
    renderer->SetBackground(low.r, low.g, low.b);
    renderer->SetBackground2(high.r, high.g, high.b);
    renderer->SetGradientBackground(bottom != top);
  };
  switch (background) {
    case Background::Dark:
      ground(0x0b0d11, 0x1c2026);
      break;
    case Background::Light:
      ground(0xe6e9ed, 0xfafbfc);
      break;
    case Background::White:
      ground(0xffffff, 0xffffff);
      break;
  }
}

}  // namespace pneuma
