#include <array>

#include "cli/paper_figure.h"
#include "views/model_scene.h"

namespace pneuma::cli {
namespace {

constexpr int KitaokaSize = 1000;
constexpr int SheetSize = 700;

/// A part of Fig. 6: the organ that was kept for it, and what it shows.
struct Projection {
  std::string_view name;
  std::string_view caption;
};

constexpr std::array<Projection, 4> Projections = {{
    {"6a", "A: no supplementary rule"},
    {"6b", "B by the caption: rules 4a, 7a, 8a"},
    {"6b-text", "B by the text: rules 4a, 6a, 7a"},
    {"6c", "C: all supplementary rules"},
}};

/// From the front, all in the frame of the tree that reaches farthest, whose failed branches leave
/// the organ: one sees what the others leave empty.
Picture projection(const Reproduction& reproduction, std::string_view name, int size) {
  SceneOptions look;
  look.background = Background::White;
  look.annotations = false;
  Scene scene;
  scene.setOptions(look);
  showModel(scene, figureModel(reproduction, "6b"));
  scene.look(viewDirection("anterior"));
  showModel(scene, figureModel(reproduction, name));
  return renderPicture(scene, size, size);
}

template <std::size_t Part>
Picture figure6Part(const Reproduction& reproduction, const Progress&) {
  return projection(reproduction, Projections[Part].name, KitaokaSize);
}

Picture figure6(const Reproduction& reproduction, const Progress& progress) {
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
  for (const Projection& part : Projections) {
    progress.report(static_cast<double>(pictures.size()) / Projections.size());
    pictures.push_back(projection(reproduction, part.name, SheetSize));
    captions.emplace_back(part.caption);
  }
  return contactSheet(pictures, 2, captions);
}

/// Every segment in a colour of its own.
Picture segments(const Reproduction& reproduction, std::string_view view) {
  SceneOptions look;
  look.background = Background::White;
  look.colourBy = ColourBy::Segment;
  Scene scene;
  scene.setOptions(look);
  showModel(scene, figureModel(reproduction, "7"));
  scene.look(viewDirection(view));
  return renderPicture(scene, KitaokaSize, KitaokaSize);
}

Picture figure7Anterior(const Reproduction& reproduction, const Progress&) {
  return segments(reproduction, "anterior");
}

Picture figure7Right(const Reproduction& reproduction, const Progress&) {
  return segments(reproduction, "right");
}

constexpr std::array<PaperFigure, 7> KitaokaPictures = {{{"fig6.png", figure6},
                                                         {"fig6a.png", figure6Part<0>},
                                                         {"fig6b.png", figure6Part<1>},
                                                         {"fig6b-text.png", figure6Part<2>},
                                                         {"fig6c.png", figure6Part<3>},
                                                         {"fig7a.png", figure7Anterior},
                                                         {"fig7b.png", figure7Right}}};

}  // namespace

std::span<const PaperFigure> kitaokaFigures() { return KitaokaPictures; }

}  // namespace pneuma::cli
