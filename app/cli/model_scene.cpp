#include "cli/model_scene.h"

#include <algorithm>

namespace pneuma::cli {

void showModel(Scene& scene, const LungModel& model, const std::vector<Lobe>& hidden) {
  std::vector<SceneSurface> surfaces;
  if (model.surfaces) {
    for (const LobeSurface& surface : *model.surfaces) {
      const bool hide = std::find(hidden.begin(), hidden.end(), surface.lobe) != hidden.end();
      surfaces.push_back({surface.lobe, surface.mesh, !hide});
    }
  }
  scene.setSurfaces(std::move(surfaces));
  scene.setTree(treeOf(model));
}

}  // namespace pneuma::cli
