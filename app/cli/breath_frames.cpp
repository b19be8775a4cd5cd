#include "cli/breath_frames.h"

#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include "render/scene.h"

namespace pneuma::cli {

std::filesystem::path framePicture(const std::filesystem::path& pvd, int frame) {
  std::array<char, 24> ending{};
  std::snprintf(ending.data(), ending.size(), "_%04d.png", frame);
  return pvd.parent_path() / pvd.stem().concat(ending.data());
}

namespace {

BreathScale scaleOf(const BreathFrame& frame) {
  BreathScale scale;
  for (const auto& [side, s] : frame.scale) (side == Side::Right ? scale.right : scale.left) = s;
  scale.chestWall = frame.chestWallScale;
  return scale;
}

}  // namespace

void drawBreath(const BreathingLungs& lungs, const FrameArguments& arguments,
                const std::function<void(int frame, const Picture& picture)>& take,
                const Progress& progress) {
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
  if (arguments.onionSkin) {
    addOnionSkin(*breathing, meshes, scaleOf(frameAt(lungs, emptiestPhase(lungs))),
                 scaleOf(frameAt(lungs, fullestPhase(lungs))));
  }
  Scene scene;
  scene.setOptions(sceneOptions(arguments.look));
  scene.setOnionSkin(arguments.onionSkin);
  scene.setSurfaces(std::move(surfaces));
  scene.setTree(lungs.tree);
  scene.setBreathing(std::move(breathing));
  scene.look(viewDirection(arguments.look.view));
  for (std::size_t n = 0; n < lungs.frames.size(); ++n) {
    progress.throwIfStopped();
    progress.report(static_cast<double>(n) / static_cast<double>(lungs.frames.size()));
    scene.setBreath(scaleOf(lungs.frames[n]));
    const auto& [width, height] = arguments.look.size;
    take(static_cast<int>(n), renderPicture(scene, width, height));
  }
}

}  // namespace pneuma::cli
