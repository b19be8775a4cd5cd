#pragma once

#include <memory>
#include <vector>

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include "render/breathing_scene.h"
#include "render/colour.h"
#include "render/scene.h"

class vtkRenderer;

namespace pneuma {

/// What is drawn around lungs that breathe, by its rim alone: the chest wall around a collapsed
/// lung, and as an onion skin where the lungs are at the ends of expiration and inspiration.
class ShellLayer {
 public:
  explicit ShellLayer(vtkRenderer* renderer) : renderer_(renderer) {}

  /// Null for nothing.
  void setBreathing(std::shared_ptr<const BreathingScene> breathing, Background background);

  void setBreath(const BreathScale& scale);

  void setOnionSkin(bool on);

  void setBackground(Background background);

  /// Points between which the shells that are shown lie at the most.
  void addPoints(std::vector<Vec3>& points) const;

  /// True if a shell of this kind is shown.
  bool shows(BreathingScene::Shell::Of of) const;

 private:
  void showActors();

  vtkRenderer* renderer_;
  std::shared_ptr<const BreathingScene> breathing_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;  ///< one for each of the shells
  bool onionSkin_ = false;
};

/// How a kind of shell is coloured and called in the legend.
struct ShellLook {
  const char* name;
  const char* brief;  ///< for small pictures
  Rgb onDark;
  Rgb onLight;
  double opacity;
};

const ShellLook& lookOf(BreathingScene::Shell::Of of);

}  // namespace pneuma
