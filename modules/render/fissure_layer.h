#pragma once

#include <optional>
#include <vector>

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkSmartPointer.h>

#include "render/fissure_scene.h"
#include "render/scene.h"

class vtkRenderer;

namespace pneuma {

/// Lungs whose fissures are edited: the lungs translucent in the colours of the lobes that they
/// would have, the fissures inside them, and the marks.
class FissureLayer {
 public:
  explicit FissureLayer(vtkRenderer* renderer) : renderer_(renderer) {}

  void show(const FissureScene& scene, const SceneOptions& options);
  void setOptions(const SceneOptions& options);

  const FissureScene& scene() const { return scene_; }

  bool empty() const { return scene_.lungs.empty(); }

  /// The lungs' first point in a straight line, as a share of the way from `from` to `to`.
  std::optional<double> firstHit(const Vec3& from, const Vec3& to) const;

 private:
  struct Lung {
    vtkSmartPointer<vtkActor> actor;
    vtkSmartPointer<vtkFloatArray> heights;  ///< over the oblique and the horizontal fissure
  };

  Lung lungOf(const FissureScene::Lung& lung) const;
  void fill(const Lung& made, const FissureScene::Lung& lung) const;
  void colour(const Lung& made, Side side) const;
  void showSheets(const std::vector<FissureScene::Sheet>& sheets);
  void showMarks(const std::vector<FissureMark>& marks);

  vtkRenderer* renderer_;
  SceneOptions options_;
  FissureScene scene_;
  std::vector<Lung> lungs_;
  std::vector<vtkSmartPointer<vtkActor>> sheets_;
  vtkSmartPointer<vtkActor> marks_;
};

}  // namespace pneuma
