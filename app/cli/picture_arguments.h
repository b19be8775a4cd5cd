#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "render/scene.h"

namespace pneuma::cli {

/// Width and height in pixels.
struct PictureSize {
  int width = 1200;
  int height = 900;
};

/// How pictures look: the arguments that all commands share that draw what they are given.
struct PictureArguments {
  std::string view = "anterior";
  PictureSize size;

  // The members below are fields, so that ranges and choices are told in one place.
  ColourBy colourBy = SceneOptions{}.colourBy;
  Palette palette = SceneOptions{}.palette;
  Background background = SceneOptions{}.background;
  int maxGeneration = SceneOptions{}.maxGeneration;
  double opacity = SceneOptions{}.lobeOpacity;
  double radiusScale = SceneOptions{}.radiusScale;

  static constexpr auto fields() {
    using P = PictureArguments;
    return std::tuple{
        Field{"colour-by", &P::colourBy, "", Range{}, "What the colour of a branch means."},
        Field{"palette", &P::palette, "", Range{},
              "Colours of the lobes: pneuma, or huang (upper red, middle green, lower blue)."},
        Field{"background", &P::background, "", Range{}, "Background."},
        Field{"max-generation", &P::maxGeneration, "", Range{0, 1000},
              "Leave out branches of higher generations (trachea: 0)."},
        Field{"opacity", &P::opacity, "", Range{0.0, 1.0}, "Opacity of the lobes."},
        Field{"radius-scale", &P::radiusScale, "", Range{0.1, 10.0},
              "Draw the branches thicker or thinner than they are."},
    };
  }
};

/// Adds --view, --size and the fields. @param sizeHelp what --size is the size of
/// @returns the options that were added
std::vector<CLI::Option*> addPictureArguments(CLI::App& app, PictureArguments& arguments,
                                              const std::string& sizeHelp);

/// With annotations.
SceneOptions sceneOptions(const PictureArguments& arguments);

/// @throws NoRendering saying how to get a display
void requireDisplay();

}  // namespace pneuma::cli
