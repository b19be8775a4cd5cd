#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/model_scene.h"
#include "cli/picture_arguments.h"
#include "cli/series_picture.h"
#include "cli/slice_arguments.h"
#include "cli/slice_sheet.h"
#include "cli/text.h"
#include "io/ct_file.h"
#include "render/movie.h"
#include "render/picture.h"
#include "render/stereo.h"

namespace pneuma::cli {
namespace {

struct RenderArguments : PictureArguments {
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> hidden;
  SliceArguments slices;
  CLI::Option* opacityOption = nullptr;
  bool noAnnotations = false;
  std::filesystem::path reference;
  std::filesystem::path difference;
  // The members below are fields.
  double threshold = 0.03;
  double time = 0.0;
  int rate = 0;
  int repeat = 1;
  Stereo stereo = Stereo::None;
  double eyeDistanceMm = StereoOptions{}.eyeDistanceMm;

  static constexpr auto fields() {
    using R = RenderArguments;
    return std::tuple{
        Field{"threshold", &R::threshold, "", Range{0.0, 1.0},
              "How different from --reference the picture may look."},
        Field{"time", &R::time, "s", Range{0.0, 1e6},
              "Of a breath (.pvd), the moment of the picture; the nearest there is."},
        Field{"rate", &R::rate, "/s", Range{0, 120},
              "Pictures a second of a film (.ogv); 0: as fast as the breath was."},
        Field{"repeat", &R::repeat, "", Range{1, 100}, "How many breaths a film shows."},
        Field{"stereo", &R::stereo, "", Range{},
              "Two eyes' pictures: for red and cyan glasses, side by side, or for crossed eyes."},
        Field{"eye-distance", &R::eyeDistanceMm, "mm", Range{1.0, 500.0},
              "How far the eyes of --stereo are apart, in the scene."},
    };
  }
};

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

bool drawsSeries(const RenderArguments& arguments) {
  return std::ranges::any_of(arguments.inputs, isSeries);
}

bool isFilm(const std::filesystem::path& path) { return path.extension() == ".ogv"; }

bool drawsSlices(const RenderArguments& arguments) {
  return arguments.slices.any() || std::ranges::any_of(arguments.inputs, isCtPath);
}

void requireUsable(const RenderArguments& arguments, const CommonOptions& common) {
  if (!arguments.difference.empty() && arguments.reference.empty()) {
    throw InvalidOption("--diff needs --reference, the picture to compare with");
  }
  if (isFilm(common.output)) {
    if (!drawsSeries(arguments)) {
      throw InvalidOption("a film needs a breath: give the .pvd of 'pneuma breathe'");
    }
    if (!arguments.reference.empty()) {
      throw InvalidOption("films are not compared; leave --reference out or draw a .png");
    }
    requireOutput(common.output, common.existing());
  } else {
    requirePngOutput(common.output, common.existing());
  }
  if (drawsSlices(arguments) && arguments.stereo != Stereo::None) {
    throw InvalidOption("slices have no depth; leave --stereo out or give surfaces and trees only");
  }
  if (drawsSeries(arguments) && arguments.inputs.size() > 1) {
    throw InvalidOption("a breath (.pvd) is drawn alone; its airways are in it");
  }
  requireOtherThanInputs(common.output, {&arguments.reference, 1});
  if (!arguments.difference.empty()) requirePngOutput(arguments.difference, common.existing());
  if (!arguments.reference.empty()) (void)readPng(arguments.reference);
  if (!drawsSlices(arguments)) requireDisplay();
}

void dress(Scene& scene, const RenderArguments& arguments) {
  SceneOptions options = sceneOptions(arguments);
  options.annotations = !arguments.noAnnotations;
  scene.setOptions(options);
}

Picture drawn(Scene& scene, const RenderArguments& arguments, const PictureSize& size) {
  return renderStereo(scene, size.width, size.height, {arguments.stereo, arguments.eyeDistanceMm});
}

Picture scenePicture(const RenderArguments& arguments, const LungModel& model,
                     const PictureSize& size) {
  Scene scene;
  dress(scene, arguments);
  showModel(scene, model, hiddenLobes(arguments.hidden));
  scene.look(viewDirection(arguments.view));
  return drawn(scene, arguments, size);
}

/// Some moments of a breath, from one place. @param take gets every picture
void drawMoments(const RenderArguments& arguments, const std::vector<SeriesMoment>& moments,
                 const std::function<void(Picture picture)>& take, const Progress& progress) {
  Scene scene;
  dress(scene, arguments);
  const std::vector<Lobe> hidden = hiddenLobes(arguments.hidden);
  drawSeries(
      moments, scene, viewDirection(arguments.view),
      [&](const LungModel& model) { showModel(scene, model, hidden); },
      [&] { take(drawn(scene, arguments, arguments.size)); }, progress);
}

ExitCode writeFilm(const RenderArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  const Series series = readSeries(arguments.inputs.front());
  const int rate = arguments.rate == 0 ? series.rate() : arguments.rate;
  Movie movie(rate);
  std::vector<Picture> pictures;
  drawMoments(
      arguments, series.moments, [&](Picture picture) { pictures.push_back(std::move(picture)); },
      progress);
  for (int n = 0; n < arguments.repeat; ++n) {
    for (const Picture& picture : pictures) movie.add(picture);
  }
  OutputSet outputs;
  outputs.add(common.output);
  writeFile(common.output, movie.finish(), common.existing());
  outputs.keep();
  if (!common.quiet) {
    std::cout << common.output.string() << ": "
              << pictures.size() * static_cast<std::size_t>(arguments.repeat) << " pictures, "
              << rate << " a second\n";
  }
  return ExitCode::Done;
}

Picture slicesPicture(const RenderArguments& arguments, const LungModel& model) {
  const SliceArguments& slices = arguments.slices;
  SliceLook look;
  look.window = greyWindow(slices.window);
  if (slices.outline) look.labels = LabelStyle::Outlined;
  if (arguments.opacityOption->count() > 0) look.opacity = arguments.opacity;
  look.annotations = !arguments.noAnnotations;
  std::vector<Vec3> markers;
  for (const std::string& marker : slices.markers) markers.push_back(markerPoint(marker));
  ScenePicture scene;
  if (wantsScene(slices.slices) && (model.surfaces || treeOf(model))) {
    requireDisplay();
    scene = [&](const PictureSize& size) { return scenePicture(arguments, model, size); };
  }
  return sliceSheet(model, wantedSlices(slices.slices), markers, look, arguments.size, scene);
}

/// Complains of what is typed wrong before anything is read.
void requireSpelled(const RenderArguments& arguments) {
  (void)viewDirection(arguments.view);
  (void)hiddenLobes(arguments.hidden);
  (void)greyWindow(arguments.slices.window);
  (void)wantedSlices(arguments.slices.slices);
  for (const std::string& marker : arguments.slices.markers) (void)markerPoint(marker);
}

ExitCode runRender(const RenderArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  requireSpelled(arguments);
  requireUsable(arguments, common);
  if (isFilm(common.output)) return writeFilm(arguments, common, progress);
  LungModel model;
  if (drawsSeries(arguments)) {
    const Series series = readSeries(arguments.inputs.front());
    model = openMoment(series.moments[series.nearestTo(arguments.time)]);
  } else {
    model = openFiles(arguments.inputs, progress.part(0.0, 0.5, "reading"));
  }
  if (!model.ct && arguments.slices.any()) {
    throw InvalidInput("slices, labels and marks need a CT, and none of the inputs is one");
  }
  if (!arguments.slices.labels.empty()) {
    model = withLabels(model, arguments.slices.labels, progress.part(0.5, 0.7, "reading labels"));
  }
  progress.part(0.7, 1.0, "rendering").report(0.0);
  const Picture picture =
      model.ct ? slicesPicture(arguments, model) : scenePicture(arguments, model, arguments.size);
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
  addFiles(app, "INPUTS", arguments->inputs,
           "Surfaces, trees and folders of them, mixed; or a CT, of which slices are drawn; or a "
           "breath (.pvd).")
      ->required();
  addOutput(app, common, "FILE", "Where the picture goes: .png; of a breath also a film: .ogv.")
      ->required();
  addPictureArguments(app, *arguments, "Width and height in pixels.");
  arguments->opacityOption = app.get_option("--opacity");
  addSliceArguments(app, arguments->slices);
  addRepeatable(app, "--hide", arguments->hidden, "{RUL|RML|RLL|LUL|LLL}",
                "Leave out this lobe's surface. May be repeated.");
  app.add_flag("--no-annotations", arguments->noAnnotations,
               "Leave out scale bar, orientation letters and legend.");
  app.add_option("--reference", arguments->reference, "Compare with this picture; exit 8 if over.")
      ->type_name("FILE");
  app.add_option("--diff", arguments->difference, "Write the difference from --reference here.")
      ->type_name("FILE");
  addFields(app, *arguments);
  return [arguments, &common](const Progress& progress) {
    return runRender(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
