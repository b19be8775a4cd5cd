#include "cli/paper_pictures.h"

#include "cli/model_scene.h"
#include "core/error.h"

namespace pneuma::cli {
namespace {

constexpr int FigureWidth = 900;
constexpr int FigureHeight = 900;
constexpr int StageWidth = 480;
constexpr int StageHeight = 480;
constexpr std::array<int, 6> Stages = {2, 3, 6, 8, 12, 14};

/// The tree alone, or the surfaces alone: the paper's figures show one of them at a time.
LungModel treeOnly(LungModel model) {
  model.surfaces = nullptr;
  return model;
}

LungModel surfacesOnly(LungModel model) {
  model.central = nullptr;
  model.growth = nullptr;
  model.opened = nullptr;
  return model;
}

Picture drawn(const LungModel& model, const SceneOptions& options, int width, int height) {
  Scene scene;
  scene.setOptions(options);
  showModel(scene, model);
  scene.look(viewDirection("anterior"));
  return renderPicture(scene, width, height);
}

/// All stages seen from the same place, so that one sees the tree grow.
Picture stagesSheet(const LungModel& model, const SceneOptions& look, const Progress& progress) {
  Scene scene;
  SceneOptions options = look;
  options.annotations = false;
  scene.setOptions(options);
  showModel(scene, model);
  scene.look(viewDirection("anterior"));
  std::vector<Picture> stages;
  std::vector<std::string> captions;
  for (const int stage : Stages) {
    progress.report(static_cast<double>(stages.size()) / static_cast<double>(Stages.size()));
    options.maxGeneration = stage;
    scene.setOptions(options);
    stages.push_back(renderPicture(scene, StageWidth, StageHeight));
    captions.push_back("up to generation " + std::to_string(stage));
  }
  return contactSheet(stages, 3, captions);
}

}  // namespace

std::vector<PaperPicture> paperPictures(const LungModel& model, const Progress& progress) {
  SceneOptions look;
  look.palette = Palette::Huang;
  look.background = Background::White;
  SceneOptions lobes = look;
  lobes.lobeOpacity = 1.0;
  const auto [fig1, fig4, fig5] = paperPictureNames();

  std::vector<PaperPicture> pictures;
  if (model.surfaces) {
    pictures.push_back(
        {std::string(fig1), drawn(surfacesOnly(model), lobes, FigureWidth, FigureHeight)});
  }
  const LungModel tree = treeOnly(model);
  pictures.push_back(
      {std::string(fig4), stagesSheet(tree, look, progress.part(0.2, 0.8, "drawing the figures"))});
  pictures.push_back({std::string(fig5), drawn(tree, look, FigureWidth, FigureHeight)});
  progress.report(1.0);
  return pictures;
}

void requireDisplay() {
  if (canRender()) return;
  throw NoRendering(
      "there is no display to render with; put 'xvfb-run -a' before the command, or start it where "
      "DISPLAY is set");
}

}  // namespace pneuma::cli
