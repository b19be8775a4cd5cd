#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include "render/breathing_scene.h"
#include "render/legend.h"
#include "render/scene.h"

class vtkRenderer;

namespace pneuma {

/// A closed surface as a veil: translucent, most where one looks straight at it.
vtkSmartPointer<vtkActor> veilOf(const TriangleMesh& mesh);

/// How opaque veils are on the background that there is.
double veilOpacity(const SceneOptions& options);

/// The translucent lobes of a scene.
class SurfaceLayer {
 public:
  explicit SurfaceLayer(vtkRenderer* renderer) : renderer_(renderer) {}

  void setSurfaces(std::vector<SceneSurface> surfaces, const SceneOptions& options);
  void setVisible(std::size_t index, bool visible);
  void setDensity(std::size_t index, double density);

  /// Lets the surfaces move, or stand (null). One of other surfaces is not taken.
  void setBreathing(std::shared_ptr<const BreathingScene> breathing, const SceneOptions& options);

  void setBreath(const BreathScale& scale);

  /// Fewer triangles, where the breathing has them.
  void setInteractive(bool interactive);

  /// The first point of a visible surface in a straight line, where the surfaces stand at the
  /// moment.
  std::optional<SurfaceHit> firstHit(const Vec3& from, const Vec3& to) const;

  /// How far a point moves at most at the moment, mm.
  double reachMm() const;

  /// Of the values that colour the points; empty if none do.
  Legend legend(Background background) const;

  const BreathingScene* breathing() const { return breathing_.get(); }

  /// Hides all of them for a while, or shows those that are visible again.
  void setShown(bool shown);

  /// @param neutral true where the colours belong to the airways alone
  void setOptions(const SceneOptions& options, bool neutral);

  const std::vector<SceneSurface>& surfaces() const { return surfaces_; }

  /// Orders the lobes from far to near, as plain alpha needs it. Cheap; call before each frame.
  void sortBackToFront();

 private:
  vtkRenderer* renderer_;
  std::vector<SceneSurface> surfaces_;
  Scale valueScale() const;
  void showActors();
  void rebuild(const SceneOptions& options);
  /// The whole surface, made when it is shown first.
  vtkActor* fine(std::size_t index);
  void colour(vtkActor* actor, std::size_t index) const;

  SceneOptions options_;
  bool neutral_ = false;
  std::vector<vtkSmartPointer<vtkActor>> actors_;  ///< null until they are shown
  std::vector<vtkSmartPointer<vtkActor>> coarse_;  ///< null where there are no fewer triangles
  std::shared_ptr<const BreathingScene> breathing_;
  BreathScale scale_;
  std::vector<double> farthestMm_;  ///< that a point of each surface moves at s = 1
  bool interactive_ = false;
  std::vector<Vec3> centres_;
  std::vector<std::size_t> order_;
  bool shown_ = true;
};

}  // namespace pneuma
