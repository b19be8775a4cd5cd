#pragma once

#include <QObject>
#include <map>
#include <memory>
#include <set>

#include "document/fissure_editor.h"
#include "document/slice_views.h"
#include "render/fissure_scene.h"

namespace pneuma {

class CtViews;
class SceneView;

/// Shows the fissures that are edited in the slices and in the 3-D view, and tells the editor what
/// is done there.
class FissureViews : public QObject {
  Q_OBJECT

 public:
  FissureViews(FissureEditor& editor, SliceViews& slices, CtViews& ctViews, SceneView& scene,
               QObject* parent = nullptr);

  /// Edits fissures, or shows those of the lobes alone.
  void setActive(bool active);

  /// Which lungs are to be seen.
  void setVisible(std::set<Side> sides);

 private:
  /// What is drawn of a fissure, and of which heights.
  struct Drawn {
    std::shared_ptr<const std::vector<float>> own;
    std::shared_ptr<const std::vector<float>> oblique;
    std::shared_ptr<const TriangleMesh> patch;
    std::shared_ptr<const TriangleMesh> traced;  ///< the patch where it was, else null
    std::shared_ptr<const std::vector<std::uint8_t>> shows;
    std::shared_ptr<const std::vector<std::vector<Vec3>>> rim;
  };

  void follow();
  void showInScene();
  void showInSlices();
  const Drawn& drawn(const LobePreview& lung, Fissure fissure);
  std::vector<FissureMark> marks() const;

  FissureEditor& editor_;
  SliceViews& slices_;
  CtViews& ctViews_;
  SceneView& scene_;
  std::map<Fissure, Drawn> drawn_;
  std::set<Side> visible_{Side::Right, Side::Left};
  bool active_ = false;
};

}  // namespace pneuma
