#include <array>

#include "cli/paper_figure.h"
#include "views/model_scene.h"

namespace pneuma::cli {
namespace {

constexpr int HuangSize = 900;
constexpr int StageSize = 480;
constexpr std::array<int, 6> Stages = {2, 3, 6, 8, 12, 14};

SceneOptions paperLook() {
  SceneOptions look;
  look.palette = Palette::Huang;
  look.background = Background::White;
  return look;
}

/// The paper's figures show the tree or the surfaces, one of them at a time.
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

Picture drawn(const LungModel& model, const SceneOptions& options) {
  Scene scene;
  scene.setOptions(options);
  showModel(scene, model);
  scene.look(viewDirection("anterior"));
  return renderPicture(scene, HuangSize, HuangSize);
}

Picture lobes(const Reproduction& reproduction, const Progress&) {
  SceneOptions look = paperLook();
  look.lobeOpacity = 1.0;
  return drawn(surfacesOnly(figureModel(reproduction, "lung")), look);
}

/// All stages seen from the same place, so that one sees the tree grow.
Picture stages(const Reproduction& reproduction, const Progress& progress) {
  Scene scene;
  SceneOptions options = paperLook();
  options.annotations = false;
  scene.setOptions(options);
  showModel(scene, treeOnly(figureModel(reproduction, "lung")));
  scene.look(viewDirection("anterior"));
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
  for (const int stage : Stages) {
    progress.report(static_cast<double>(pictures.size()) / static_cast<double>(Stages.size()));
    options.maxGeneration = stage;
    scene.setOptions(options);
    pictures.push_back(renderPicture(scene, StageSize, StageSize));
    captions.push_back("up to generation " + std::to_string(stage));
  }
  return contactSheet(pictures, 3, captions);
}

Picture wholeTree(const Reproduction& reproduction, const Progress&) {
  return drawn(treeOnly(figureModel(reproduction, "lung")), paperLook());
}

constexpr std::array<PaperFigure, 3> HuangPictures = {
    {{"fig1.png", lobes}, {"fig4.png", stages}, {"fig5.png", wholeTree}}};

}  // namespace

std::span<const PaperFigure> huangFigures() { return HuangPictures; }

}  // namespace pneuma::cli
