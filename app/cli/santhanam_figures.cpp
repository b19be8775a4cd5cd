#include <array>

#include "breathing/strain_assignment.h"
#include "cli/paper_figure.h"
#include "render/chart.h"
#include "views/model_scene.h"

namespace pneuma::cli {
namespace {

constexpr int SanthanamSize = 900;
constexpr std::array<std::uint32_t, 7> StrainColours = {0x23272e, 0x1f6fc8, 0xe0872a, 0x8a4fbf,
                                                        0xc83232, 0x2a9650, 0x9a7b4f};

/// Fig. 5 as Table 3 and section 5.3 have it: a disease is another curve.
Picture strainCurves(const Reproduction&, const Progress&) {
  Chart chart{"", "distance from the diaphragm's centroid, share of the largest", "strain", {}};
  for (std::size_t n = 0; n < choices(StrainPreset{}).size(); ++n) {
    const auto preset = static_cast<StrainPreset>(n);
    const StrainCurve curve = strainCurve(preset);
    ChartCurve drawn{std::string(choices(preset)[n]), {}, {}, rgbOfHex(StrainColours[n])};
    for (int step = 0; step <= 200; ++step) {
      drawn.x.push_back(step / 200.0);
      drawn.y.push_back(curve.at(drawn.x.back()));
    }
    chart.curves.push_back(std::move(drawn));
  }
  return chartPicture(chart, SanthanamSize, SanthanamSize * 2 / 3);
}

SceneOptions lungLook(double opacity) {
  SceneOptions look;
  look.background = Background::White;
  look.lobeOpacity = opacity;
  look.legend = false;
  return look;
}

/// Looked at from where the lungs breathed in fill the picture, so that one sees them grow.
Picture lungsAt(const Reproduction& reproduction, std::string_view moment) {
  Scene scene;
  scene.setOptions(lungLook(1.0));
  showModel(scene, figureModel(reproduction, "inspired"));
  scene.look(viewDirection("anterior"));
  showModel(scene, figureModel(reproduction, moment));
  return renderPicture(scene, SanthanamSize, SanthanamSize);
}

Picture atRest(const Reproduction& reproduction, const Progress&) {
  return lungsAt(reproduction, "rest");
}

Picture breathedIn(const Reproduction& reproduction, const Progress&) {
  return lungsAt(reproduction, "inspired");
}

Picture bothMoments(const Reproduction& reproduction, const Progress&) {
  std::vector<LobeSurface> surfaces = *figureModel(reproduction, "rest").surfaces;
  const std::vector<LobeSurface>& inspired = *figureModel(reproduction, "inspired").surfaces;
  for (LobeSurface& surface : surfaces) {  // another colour than those that are breathed in
    surface.lobe = surface.lobe == Lobe::RightLower ? Lobe::RightUpper : Lobe::LeftUpper;
  }
  surfaces.insert(surfaces.end(), inspired.begin(), inspired.end());
  LungModel both;
  both.surfaces = std::make_shared<const std::vector<LobeSurface>>(std::move(surfaces));
  Scene scene;
  scene.setOptions(lungLook(0.35));
  showModel(scene, both);
  scene.look(viewDirection("anterior"));
  return renderPicture(scene, SanthanamSize, SanthanamSize);
}

constexpr std::array<PaperFigure, 4> Santhanam2003Pictures = {{{"fig5.png", strainCurves},
                                                               {"fig6.png", atRest},
                                                               {"fig7.png", breathedIn},
                                                               {"fig8.png", bothMoments}}};

}  // namespace

std::span<const PaperFigure> santhanam2003Figures() { return Santhanam2003Pictures; }

}  // namespace pneuma::cli
