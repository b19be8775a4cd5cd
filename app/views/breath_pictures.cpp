#include "views/breath_pictures.h"

#include <memory>
#include <utility>
#include <vector>

#include "render/steady_view.h"

namespace pneuma {
namespace {

/// Lungs, airways and chest wall, as they move.
void showBreath(Scene& scene, const BreathingLungs& lungs, bool onionSkin) {
  std::vector<SceneSurface> surfaces;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;
  auto breathing = std::make_shared<BreathingScene>();
  for (const MovingSurface& surface : lungs.surfaces) {
    meshes.push_back(surface.surface.mesh);
    surfaces.push_back({surface.surface.lobe, meshes.back()});
    breathing->surfaces.push_back({surface.side, surface.displacement, {}});
  }
  breathing->tree = lungs.treeMotion;
  if (lungs.chestWall) {
    const LungMotion& chest = *lungs.chestWall;
    breathing->shells.push_back(
        shellOf(BreathingScene::Shell::Of::ChestWall, chest.side(), chest.wall(), chest.ofWall()));
  }
  if (onionSkin) {
    addOnionSkin(*breathing, meshes, breathScale(frameAt(lungs, emptiestPhase(lungs))),
                 breathScale(frameAt(lungs, fullestPhase(lungs))));
  }
  scene.setOnionSkin(onionSkin);
  scene.setSurfaces(std::move(surfaces));
  scene.setTree(lungs.tree);
  scene.setBreathing(std::move(breathing));
}

}  // namespace

BreathScale breathScale(const BreathFrame& frame) {
  BreathScale scale;
  for (const auto& [side, s] : frame.scale) (side == Side::Right ? scale.right : scale.left) = s;
  scale.chestWall = frame.chestWallScale;
  return scale;
}

void drawBreath(const BreathingLungs& lungs, std::span<const BreathFrame> frames,
                const BreathLook& look,
                const std::function<void(int frame, const Picture& picture)>& take,
                const Progress& progress) {
  Scene scene;
  scene.setOptions(look.options);
  showBreath(scene, lungs, look.onionSkin);
  progress.throwIfStopped();
  scene.look(look.view);
  SteadyView view(scene, look.width, look.height);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    progress.report(static_cast<double>(n) / static_cast<double>(frames.size()));
    scene.setBreath(breathScale(frames[n]));
    const Picture picture = view.draw();
    progress.throwIfStopped();
    take(static_cast<int>(n), picture);
  }
}

}  // namespace pneuma
