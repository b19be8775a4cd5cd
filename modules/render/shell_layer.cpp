#include "render/shell_layer.h"

#include <algorithm>
#include <array>
#include <utility>

#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

#include "render/breath_shader.h"
#include "render/surface_layer.h"

namespace pneuma {
namespace {

// An outline that fades inwards and leaves what is within it as it is.
constexpr const char* OutlineShader = R"(//VTK::Light::Impl
  float rim = 1.0 - abs(dot(normalVCVSOutput, normalize(vertexVC.xyz)));
  gl_FragData[0] = vec4(diffuseColor, min(1.0, opacity * mix(0.03, 1.0, rim * rim * rim)));
)";

}  // namespace

const ShellLook& lookOf(BreathingScene::Shell::Of of) {
  static const std::array<ShellLook, 3> looks = {{
      {"Chest wall", "Chest", rgbOfHex(0xc9d6ea), rgbOfHex(0x46536a), 0.75},
      {"End of expiration", "Exp.", rgbOfHex(0x7fd6ff), rgbOfHex(0x1668b0), 0.85},
      {"End of inspiration", "Insp.", rgbOfHex(0xffb45c), rgbOfHex(0xb85a00), 0.85},
  }};
  return looks[static_cast<std::size_t>(of)];
}

void ShellLayer::setBreathing(std::shared_ptr<const BreathingScene> breathing,
                              Background background) {
  if (breathing == breathing_) return;
  // Scenes of one breath in other colours share their shells' meshes.
  breathing_ = std::move(breathing);
  for (const auto& actor : actors_) renderer_->RemoveActor(actor);
  actors_.clear();
  if (!breathing_) return;
  for (const BreathingScene::Shell& shell : breathing_->shells) {
    vtkSmartPointer<vtkActor> actor = veilOf(*shell.mesh);
    actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                                             OutlineShader, false);
    // Shells may be open, so that their volume says nothing about which side is the outer one.
    actor->GetProperty()->BackfaceCullingOn();
    actor->GetProperty()->FrontfaceCullingOff();
    auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
    letBreathe(actor, mapper->GetInput(),
               breathAttributes(*shell.mesh, shell.displacement, shell.side));
    pneuma::setBreath(actor, {shell.scale, shell.scale});
    renderer_->AddActor(actor);
    actors_.push_back(std::move(actor));
  }
  setBackground(background);
  showActors();
}

void ShellLayer::setBreath(const BreathScale& scale) {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    if (breathing_->shells[i].of != BreathingScene::Shell::Of::ChestWall) continue;
    pneuma::setBreath(actors_[i], {scale.chestWall, scale.chestWall});
  }
}

void ShellLayer::setOnionSkin(bool on) {
  onionSkin_ = on;
  showActors();
}

void ShellLayer::setBackground(Background background) {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    const ShellLook& look = lookOf(breathing_->shells[i].of);
    const Rgb& colour = background == Background::Dark ? look.onDark : look.onLight;
    actors_[i]->GetProperty()->SetColor(colour.r, colour.g, colour.b);
    actors_[i]->GetProperty()->SetOpacity(look.opacity);
  }
}

void ShellLayer::addPoints(std::vector<Vec3>& points) const {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    const BreathingScene::Shell& shell = breathing_->shells[i];
    if (!shows(shell.of)) continue;
    for (std::size_t n = 0; n < shell.mesh->points.size(); ++n) {
      points.push_back(shell.mesh->points[n]);
      points.push_back(shell.mesh->points[n] + shell.displacement[n]);
    }
  }
}

bool ShellLayer::shows(BreathingScene::Shell::Of of) const {
  if (of != BreathingScene::Shell::Of::ChestWall && !onionSkin_) return false;
  return breathing_ && std::ranges::any_of(breathing_->shells,
                                           [of](const auto& shell) { return shell.of == of; });
}

void ShellLayer::showActors() {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    actors_[i]->SetVisibility(shows(breathing_->shells[i].of));
  }
}

}  // namespace pneuma
