#include "cli/comparison_picture.h"

#include <algorithm>
#include <cmath>

#include "cli/text.h"
#include "pipeline/organs.h"
#include "views/model_scene.h"

namespace pneuma::cli {
namespace {

constexpr int MostColumns = 4;
constexpr double CellsAcross = 64.0;  // of the lattice by which an organ gets a surface

/// A built-in organ is known by its formula; what is drawn of it is sampled.
LungModel withSurfaces(LungModel organ) {
  if (organ.surfaces || !organ.regions) return organ;
  double volumeMm3 = 0.0;
  for (const LobeRegion& region : *organ.regions) volumeMm3 += region.domain->volumeMm3();
  organ.surfaces = surfacesOf(*organ.regions, std::cbrt(volumeMm3) / CellsAcross);
  return organ;
}

std::string captionOf(const ComparedTree& tree) {
  const std::string method = tree.opened.method();
  return tree.opened.label + "\n" + (method.empty() ? "" : method + ", ") +
         grouped(static_cast<double>(tree.measured.whole.terminals)) + " terminals";
}

/// What lies right of `left`.
Picture rightOf(const Picture& picture, int left) {
  Picture part{picture.width - left, picture.height, {}};
  const auto width = static_cast<std::ptrdiff_t>(picture.width) * 3;
  for (auto row = picture.rgb.begin(); row != picture.rgb.end(); row += width) {
    part.rgb.insert(part.rgb.end(), row + static_cast<std::ptrdiff_t>(left) * 3, row + width);
  }
  return part;
}

/// The legend, which is the same for all trees, cut from a picture that has it.
Picture legendOf(Scene& scene, const PictureSize& size) {
  const Picture picture = renderPicture(scene, size.width, size.height);
  return rightOf(picture, picture.width - scene.legendWidth());
}

/// Rows as even as they can be.
int columnsFor(int pictures) {
  const int rows = (pictures + MostColumns - 1) / MostColumns;
  return (pictures + rows - 1) / rows;
}

}  // namespace

Picture comparisonPicture(const TreeComparison& comparison, const LungModel& organ,
                          const PictureArguments& arguments, const Progress& progress) {
  std::vector<std::shared_ptr<const AirwayTree>> trees;
  for (const ComparedTree& tree : comparison.trees) trees.push_back(tree.opened.tree);
  LungModel model = withSurfaces(organ);
  model.opened = trees.front();
  const ViewDirection view = viewDirection(arguments.view);
  SceneOptions options = sceneOptions(arguments);
  Scene scene;
  scene.setOptions(options);
  scene.setPeers(trees);
  showModel(scene, model);
  scene.look(view);
  progress.report(0.0);
  const Picture legend = legendOf(scene, arguments.size);
  options.legend = false;
  scene.setOptions(options);
  scene.look(view);
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
  for (const ComparedTree& tree : comparison.trees) {
    progress.report(static_cast<double>(pictures.size() + 1) /
                    static_cast<double>(trees.size() + 1));
    scene.setTree(tree.opened.tree);
    pictures.push_back(renderPicture(scene, arguments.size.width, arguments.size.height));
    captions.push_back(captionOf(tree));
  }
  return contactSheet(pictures, columnsFor(static_cast<int>(pictures.size())), captions, legend);
}

}  // namespace pneuma::cli
