#include "views/model_scene.h"

#include <algorithm>
#include <memory>

namespace pneuma {
namespace {

std::vector<Vec3> stillPoints(const TriangleMesh& mesh) {
  return std::vector<Vec3>(mesh.points.size(), Vec3::Zero());
}

}  // namespace

std::vector<SceneSurface> sceneSurfaces(
    const std::shared_ptr<const std::vector<LobeSurface>>& surfaces) {
  std::vector<SceneSurface> drawn;
  if (!surfaces) return drawn;
  for (const LobeSurface& surface : *surfaces) drawn.push_back({surface.lobe, surface.mesh});
  return drawn;
}

void showModel(Scene& scene, const LungModel& model, const std::vector<Lobe>& hidden) {
  std::vector<SceneSurface> surfaces;
  auto still = std::make_shared<BreathingScene>();
  if (model.surfaces) {
    for (const LobeSurface& surface : *model.surfaces) {
      if (surface.name == ChestWallName) {
        still->shells.push_back(shellOf(BreathingScene::Shell::Of::ChestWall, Side::None,
                                        *surface.mesh, stillPoints(*surface.mesh)));
        continue;
      }
      const bool hide = std::find(hidden.begin(), hidden.end(), surface.lobe) != hidden.end();
      surfaces.push_back({surface.lobe, surface.mesh, !hide});
    }
  }
  if (!still->shells.empty()) {
    for (const SceneSurface& surface : surfaces) {
      still->surfaces.push_back({side(surface.lobe), stillPoints(*surface.mesh), {}});
    }
  }
  scene.setSurfaces(std::move(surfaces));
  scene.setTree(treeOf(model));
  // Without one nothing breathes: setSurfaces() ended what did before.
  if (!still->shells.empty()) scene.setBreathing(std::move(still));
}

}  // namespace pneuma
