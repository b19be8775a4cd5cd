#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/model_scene.h"
#include "cli/text.h"
#include "pipeline/report.h"
#include "render/picture.h"

namespace pneuma::cli {
namespace {

constexpr int SmallestSide = 16;
constexpr int LargestSide = 8192;

struct PictureSize {
  int width = 1200;
  int height = 900;
};

struct RenderArguments {
  std::vector<std::filesystem::path> inputs;
  std::string view = "anterior";
  PictureSize size;
  std::vector<std::string> hidden;
  bool noAnnotations = false;
  std::filesystem::path reference;
  std::filesystem::path difference;

  // The members below are fields, so that ranges and choices are told in one place.
  ColourBy colourBy = SceneOptions{}.colourBy;
  Palette palette = SceneOptions{}.palette;
  Background background = SceneOptions{}.background;
  int maxGeneration = SceneOptions{}.maxGeneration;
  double opacity = SceneOptions{}.lobeOpacity;
  double radiusScale = SceneOptions{}.radiusScale;
  double threshold = 0.03;

  static constexpr auto fields() {
    using R = RenderArguments;
    return std::tuple{
        Field{"colour-by", &R::colourBy, "", Range{}, "What the colour of a branch means."},
        Field{"palette", &R::palette, "", Range{},
              "Colours of the lobes: pneuma, or huang (upper red, middle green, lower blue)."},
        Field{"background", &R::background, "", Range{}, "Background."},
        Field{"max-generation", &R::maxGeneration, "", Range{0, 1000},
              "Leave out branches of higher generations (trachea: 0)."},
        Field{"opacity", &R::opacity, "", Range{0.0, 1.0}, "Opacity of the lobes."},
        Field{"radius-scale", &R::radiusScale, "", Range{0.1, 10.0},
              "Draw the branches thicker or thinner than they are."},
        Field{"threshold", &R::threshold, "", Range{0.0, 1.0},
              "How different from --reference the picture may look."},
    };
  }
};

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

SceneOptions sceneOptions(const RenderArguments& arguments) {
  return {.colourBy = arguments.colourBy,
          .palette = arguments.palette,
          .background = arguments.background,
          .maxGeneration = arguments.maxGeneration,
          .lobeOpacity = arguments.opacity,
          .radiusScale = arguments.radiusScale,
          .annotations = !arguments.noAnnotations};
}

std::vector<Lobe> hiddenLobes(const std::vector<std::string>& names) {
  std::vector<Lobe> lobes;
  for (const std::string& name : names) {
    const std::optional<Lobe> lobe = lobeOfShortName(name);
    if (!lobe) {
      throw InvalidOption("--hide knows RUL, RML, RLL, LUL, LLL, but '" + name + "' was given");
    }
    lobes.push_back(*lobe);
  }
  return lobes;
}

void requireUsable(const RenderArguments& arguments, const CommonOptions& common) {
  if (!arguments.difference.empty() && arguments.reference.empty()) {
    throw InvalidOption("--diff needs --reference, the picture to compare with");
  }
  requirePngOutput(common.output, common.existing());
  if (!arguments.difference.empty()) requirePngOutput(arguments.difference, common.existing());
  if (!arguments.reference.empty()) (void)readPng(arguments.reference);
  if (!canRender()) {
    throw NoRendering(
        "there is no display to render with; run the command under 'xvfb-run -a', for example "
        "xvfb-run -a pneuma render lobes -o lobes.png");
  }
}

ExitCode runRender(const RenderArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  const ViewDirection view = viewDirection(arguments.view);
  const std::vector<Lobe> hidden = hiddenLobes(arguments.hidden);
  requireUsable(arguments, common);
  const LungModel model = openFiles(arguments.inputs, progress.part(0.0, 0.5, "reading"));

  Scene scene;
  scene.setOptions(sceneOptions(arguments));
  showModel(scene, model, hidden);
  scene.look(view);
  progress.part(0.5, 1.0, "rendering").report(0.0);
  const Picture picture = renderPicture(scene, arguments.size.width, arguments.size.height);
  progress.report(1.0);

  OutputSet outputs;
  outputs.add(common.output);
  writeFile(common.output, pngText(picture), common.existing());
  ExitCode code = ExitCode::Done;
  if (!arguments.reference.empty()) {
    const PictureDifference found = compare(picture, readPng(arguments.reference));
    if (!arguments.difference.empty()) {
      outputs.add(arguments.difference);
      writeFile(arguments.difference, pngText(found.difference), common.existing());
    }
    const bool same = found.error <= arguments.threshold;
    if (!same) code = ExitCode::ComparisonOverLimit;
    std::cout << "difference from " << arguments.reference.string() << ": " << fixed(found.error, 4)
              << ", " << (same ? "within" : "over") << " the limit of "
              << fixed(arguments.threshold, 4) << "\n";
  }
  outputs.keep();
  if (!common.quiet) {
    printWarnings(model.warnings);
    std::cout << common.output.string() << ": " << picture.width << " x " << picture.height
              << " pixels\n";
  }
  return code;
}

}  // namespace

Run declareRender(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<RenderArguments>();
  addFiles(app, "INPUTS", arguments->inputs, "Surfaces, trees and folders of them, mixed.")
      ->required();
  addOutput(app, common, "FILE", "Where the picture goes: .png.")->required();
  app.add_option("--view", arguments->view,
                 "From where to look; A P L R S I or AZ,EL in degrees also work.")
      ->type_name("{anterior|posterior|left|right|superior|inferior}")
      ->default_str(arguments->view);
  addFields(app, *arguments);
  app.add_option_function<std::string>(
         "--size", [arguments](const std::string& text) { arguments->size = parsedSize(text); },
         "Width and height in pixels.")
      ->type_name("WxH")
      ->default_str("1200x900");
  addRepeatable(app, "--hide", arguments->hidden, "{RUL|RML|RLL|LUL|LLL}",
                "Leave out this lobe's surface. May be repeated.");
  app.add_flag("--no-annotations", arguments->noAnnotations,
               "Leave out scale bar, orientation letters and legend.");
  app.add_option("--reference", arguments->reference, "Compare with this picture; exit 8 if over.")
      ->type_name("FILE");
  app.add_option("--diff", arguments->difference, "Write the difference from --reference here.")
      ->type_name("FILE");
  return [arguments, &common](const Progress& progress) {
    return runRender(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
