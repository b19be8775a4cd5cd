#include "render/four_sides.h"

#include <array>
#include <utility>

namespace pneuma {

std::vector<SideView> fourSides(const std::vector<SceneSurface>& surfaces,
                                const std::shared_ptr<const AirwayTree>& tree,
                                const Progress& progress, int side) {
  if (surfaces.empty() && !tree) return {};
  Scene scene;
  SceneOptions options;
  options.background = Background::White;
  options.legend = false;
  scene.setOptions(options);
  scene.setSurfaces(surfaces);
  scene.setTree(tree);
  std::vector<SideView> views;
  constexpr std::array<std::pair<const char*, const char*>, 4> Sides = {
      {{"anterior", "From the front"},
       {"left", "From the left"},
       {"posterior", "From behind"},
       {"right", "From the right"}}};
  for (const auto& [view, caption] : Sides) {
    progress.throwIfStopped();
    scene.look(viewDirection(view));
    views.push_back({caption, renderPicture(scene, side, side)});
    progress.report(static_cast<double>(views.size()) / static_cast<double>(Sides.size()));
  }
  return views;
}

}  // namespace pneuma
