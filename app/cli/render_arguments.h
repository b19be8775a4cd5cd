#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "anatomy/lobe.h"
#include "cli/picture_arguments.h"
#include "cli/slice_arguments.h"
#include "render/stereo.h"

namespace pneuma::cli {

/// One picture as `pneuma render` draws it: what is in it, and how it looks.
struct DrawingArguments : PictureArguments {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> hidden;
  SliceArguments slices;
  CLI::Option* opacityOption = nullptr;
  CLI::Option* viewOption = nullptr;
  bool noAnnotations = false;
  // The members below are fields.
  double time = 0.0;
  Stereo stereo = Stereo::None;
  double eyeDistanceMm = StereoOptions{}.eyeDistanceMm;

  static constexpr auto fields() {
    using D = DrawingArguments;
    return std::tuple{
        Field{
            "time", &D::time, "s", Range{0.0, 1e6},
            "Of a breath (.pvd), the moment of the picture, or of the first of --pose; the nearest "
            "there is."},
        Field{"stereo", &D::stereo, "", Range{},
              "Two eyes' pictures: for red and cyan glasses, side by side, or for crossed eyes."},
        Field{"eye-distance", &D::eyeDistanceMm, "mm", Range{1.0, 500.0},
              "How far the eyes of --stereo are apart, in the scene."},
    };
  }
};

/// Adds INPUTS and all that says how they are drawn. `arguments` outlives `app`.
void addDrawingArguments(CLI::App& app, DrawingArguments& arguments);

/// @throws InvalidOption for a name that is no lobe's
std::vector<Lobe> hiddenLobes(const std::vector<std::string>& names);

/// True if one of the inputs is a breath.
bool drawsSeries(const DrawingArguments& arguments);

/// True if slices are drawn, as far as names tell.
bool drawsSlices(const DrawingArguments& arguments);

/// Complains of what is typed wrong, or does not go together, before anything is read.
/// @throws InvalidOption
void requireSpelled(const DrawingArguments& arguments);

}  // namespace pneuma::cli
