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

void drawBreath(const BreathingLungs& lungs, const PictureArguments& arguments,
                const std::function<void(int frame, const Picture& picture)>& take,
                const Progress& progress) {
  std::vector<SceneSurface> surfaces;
  auto breathing = std::make_shared<BreathingScene>();
  for (const MovingSurface& surface : lungs.surfaces) {
    surfaces.push_back({surface.surface.lobe, surface.surface.mesh});
    breathing->surfaces.push_back({surface.side, surface.displacement, {}});
  }
  breathing->tree = lungs.treeMotion;
  Scene scene;
  scene.setOptions(sceneOptions(arguments));
  scene.setSurfaces(std::move(surfaces));
  scene.setTree(lungs.tree);
  scene.setBreathing(std::move(breathing));
  scene.look(viewDirection(arguments.view));
  for (std::size_t n = 0; n < lungs.frames.size(); ++n) {
    progress.throwIfStopped();
    progress.report(static_cast<double>(n) / static_cast<double>(lungs.frames.size()));
    BreathScale scale;
    for (const auto& [side, s] : lungs.frames[n].scale) {
      (side == Side::Right ? scale.right : scale.left) = s;
    }
    scene.setBreath(scale);
    take(static_cast<int>(n), renderPicture(scene, arguments.size.width, arguments.size.height));
  }
}

}  // namespace pneuma::cli
