#include <array>

#include "cli/outline_picture.h"
#include "cli/paper_figure.h"
#include "growth/outline_aggregation.h"
#include "views/model_scene.h"

namespace pneuma::cli {
namespace {

constexpr int ZhangSize = 900;

/// Fig. 1: a right lung, 80 key points, 10,000 particles.
Picture outline(const Reproduction&, const Progress& progress) {
  return outlinePicture(growInOutline({}, progress));
}

/// Long steps, and two other centres, side by side with Fig. 1.
Picture variations(const Reproduction&, const Progress& progress) {
  const std::array<std::pair<const char*, OutlineAggregationOptions>, 5> experiments = {
      {{"Fig. 1", {}},
       {"steps of 10 pixels", {.step = 10, .reach = 10}},
       {"centre 30 mm lower", {.seedZMm = -30.0}},
       {"centre 40 mm outwards", {.seedXMm = 40.0}},
       {"walls absorb, 10,000 steps", {.wall = Wall::Absorb, .mostSteps = 10000.0}}}};
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
  for (const auto& [caption, options] : experiments) {
    const double done = static_cast<double>(pictures.size()) / experiments.size();
    pictures.push_back(outlinePicture(
        growInOutline(options, progress.part(done, done + 0.2, "aggregating in the outline"))));
    captions.emplace_back(caption);
  }
  return contactSheet(pictures, static_cast<int>(pictures.size()), captions);
}

Picture lung(const Reproduction& reproduction, const Progress&) {
  Scene scene;
  SceneOptions look;
  look.background = Background::White;
  scene.setOptions(look);
  showModel(scene, figureModel(reproduction, "lung"));
  scene.look(viewDirection("anterior"));
  return renderPicture(scene, ZhangSize, ZhangSize);
}

constexpr std::array<PaperFigure, 3> ZhangPictures = {
    {{"fig1.png", outline}, {"variations.png", variations}, {"lung.png", lung}}};

}  // namespace

std::span<const PaperFigure> zhangFigures() { return ZhangPictures; }

}  // namespace pneuma::cli
