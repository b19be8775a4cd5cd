#include "cli/picture_arguments.h"

#include <algorithm>
#include <charconv>

#include "cli/limits.h"
#include "core/error.h"
#include "render/display.h"
#include "render/picture.h"

namespace pneuma::cli {
namespace {

constexpr int SmallestSide = 16;
constexpr int LargestSide = 8192;

PictureSize parsedSize(const std::string& text) {
  PictureSize size;
  const char* const end = text.data() + text.size();
  const auto [cross, widthError] = std::from_chars(text.data(), end, size.width);
  const bool hasCross =
      widthError == std::errc{} && cross != end && (*cross == 'x' || *cross == 'X');
  const auto [rest, heightError] = hasCross
                                       ? std::from_chars(cross + 1, end, size.height)
                                       : std::from_chars_result{end, std::errc::invalid_argument};
  if (heightError != std::errc{} || rest != end) {
    throw InvalidOption("--size needs WIDTHxHEIGHT in pixels, but '" + text + "' was given");
  }
  if (std::min(size.width, size.height) < SmallestSide ||
      std::max(size.width, size.height) > LargestSide) {
    throw InvalidOption("--size must lie in [" + std::to_string(SmallestSide) + ", " +
                        std::to_string(LargestSide) + "] pixels each way, but is " + text);
  }
  return size;
}

}  // namespace

std::vector<CLI::Option*> addPictureArguments(CLI::App& app, PictureArguments& arguments,
                                              const std::string& sizeHelp) {
  std::vector<CLI::Option*> options;
  options.push_back(app.add_option("--view", arguments.view,
                                   "From where to look; A P L R S I or AZ,EL in degrees also "
                                   "work.")
                        ->type_name("{anterior|posterior|left|right|superior|inferior}")
                        ->default_str(arguments.view));
  forEachField<PictureArguments>(
      [&](const auto& field) { options.push_back(addField(app, arguments, field)); });
  options.push_back(
      app.add_option_function<std::string>(
             "--size", [&arguments](const std::string& text) { arguments.size = parsedSize(text); },
             sizeHelp)
          ->type_name("WxH")
          ->default_str(std::to_string(arguments.size.width) + "x" +
                        std::to_string(arguments.size.height)));
  return options;
}

SceneOptions sceneOptions(const PictureArguments& arguments) {
  return {.colourBy = arguments.colourBy,
          .palette = arguments.palette,
          .background = arguments.background,
          .maxGeneration = arguments.maxGeneration,
          .lobeOpacity = arguments.opacity,
          .radiusScale = arguments.radiusScale};
}

void requireDisplay() {
  requireMemoryForDrawing();
  const std::string problem = displayProblem();
  if (problem.empty()) return;
  throw NoRendering(
      problem +
      ", so no picture can be made; put 'xvfb-run -a' before the command, or start it "
      "where a display draws OpenGL 3.2 (LIBGL_ALWAYS_SOFTWARE=1 may help)");
}

}  // namespace pneuma::cli
