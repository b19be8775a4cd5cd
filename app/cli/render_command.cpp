#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/drawn_picture.h"
#include "cli/files.h"
#include "cli/pose_picture.h"
#include "cli/render_arguments.h"
#include "cli/series_picture.h"
#include "cli/text.h"
#include "render/movie.h"
#include "render/picture.h"
#include "views/model_scene.h"

namespace pneuma::cli {
namespace {

struct RenderArguments : DrawingArguments {
  std::filesystem::path poses;
  std::filesystem::path reference;
  std::filesystem::path difference;
  // The members below are fields.
  double threshold = 0.03;
  double rate = 0.0;
  int repeat = 1;

  static constexpr auto fields() {
    using R = RenderArguments;
    return std::tuple{
        Field{"threshold", &R::threshold, "", Range{0.0, 1.0},
              "How different from --reference the picture may look."},
        Field{"rate", &R::rate, "/s", Range{0.0, 120.0},
              "Pictures a second of a film (.ogv), a whole number; 0: as fast as the breath was. "
              "Of --pose, poses a second; 0: one every 15 ms (66.7)."},
        Field{"repeat", &R::repeat, "", Range{1, 100}, "How many breaths a film shows."},
    };
  }
};

bool isFilm(const std::filesystem::path& path) { return path.extension() == ".ogv"; }

/// What does not go with --pose, and what goes only with it.
void requireUsablePoses(const RenderArguments& arguments, const CommonOptions& common) {
  if (arguments.poses.empty()) {
    if (common.json) throw InvalidOption("--json tells how poses were replayed; give --pose too");
    if (std::floor(arguments.rate) != arguments.rate) {
      throw InvalidOption("--rate of a film is a whole number of pictures a second");
    }
    return;
  }
  if (drawsSlices(arguments)) {
    throw InvalidOption("--pose looks at surfaces and trees; give no CT and no slices with it");
  }
  if (arguments.viewOption->count() > 0) {
    throw InvalidOption("poses say from where one looks; leave --view or --pose out");
  }
  if (arguments.repeat != 1) {
    throw InvalidOption(
        "poses are replayed once, the breath as long as they last; leave --repeat "
        "out");
  }
  requireOtherThanInputs(common.output, {&arguments.poses, 1});
}

void requireUsable(const RenderArguments& arguments, const CommonOptions& common) {
  requireUsablePoses(arguments, common);
  if (!arguments.difference.empty() && arguments.reference.empty()) {
    throw InvalidOption("--diff needs --reference, the picture to compare with");
  }
  if (isFilm(common.output)) {
    if (!drawsSeries(arguments) && arguments.poses.empty()) {
      throw InvalidOption("a film needs a breath: give the .pvd of 'pneuma breathe', or --pose");
    }
    if (!arguments.reference.empty()) {
      throw InvalidOption("films are not compared; leave --reference out or draw a .png");
    }
    requireOutput(common.output, common.existing());
  } else {
    requirePngOutput(common.output, common.existing());
  }
  requireOtherThanInputs(common.output, {&arguments.reference, 1});
  if (!arguments.difference.empty()) requirePngOutput(arguments.difference, common.existing());
  if (!arguments.reference.empty()) (void)readPng(arguments.reference);
  if (!drawsSlices(arguments)) requireDisplay();
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
      [&] { take(drawnScene(scene, arguments, arguments.size)); }, progress);
}

ExitCode writeFilm(const RenderArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  const Series series = readSeries(arguments.inputs.front());
  const int rate = arguments.rate == 0.0 ? series.rate() : static_cast<int>(arguments.rate);
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

/// Writes the picture and compares it if that is wanted.
ExitCode keepPicture(const RenderArguments& arguments, const CommonOptions& common,
                     const Picture& picture) {
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
  return code;
}

/// Lungs that a head looks at: a breath, whose moments are all in memory, or such that stand.
class ModelOfReplay {
 public:
  ModelOfReplay(const RenderArguments& arguments, const Progress& progress)
      : hidden_(hiddenLobes(arguments.hidden)), from_(arguments.time) {
    if (!drawsSeries(arguments)) {
      models_.push_back(openFiles(arguments.inputs, progress));
      if (!models_.front().surfaces && !treeOf(models_.front())) {
        throw InvalidInput("--pose looks at surfaces and trees, and the inputs hold none");
      }
      return;
    }
    series_ = readSeries(arguments.inputs.front());
    for (const SeriesMoment& moment : series_.moments) {
      progress.report(static_cast<double>(models_.size()) /
                      static_cast<double>(series_.moments.size()));
      models_.push_back(openMoment(moment));
    }
  }

  const std::vector<std::string>& warnings() const { return models_.front().warnings; }

  /// @param seconds since the replay's start
  void showAt(double seconds, Scene& scene) {
    const std::size_t moment =
        series_.moments.empty() ? 0 : series_.nearestInBreaths(from_ + seconds);
    if (shown_ == moment) return;
    showModel(scene, models_[moment], hidden_);
    shown_ = moment;
  }

 private:
  std::vector<Lobe> hidden_;
  double from_;
  Series series_;
  std::vector<LungModel> models_;
  std::optional<std::size_t> shown_;
};

Json parametersOfReplay(const RenderArguments& arguments, double rate) {
  const auto& [width, height] = arguments.size;
  return {{"rate_hz", rate},
          {"stereo", choices(Stereo{})[static_cast<std::size_t>(arguments.stereo)]},
          {"eye_distance_mm", arguments.eyeDistanceMm},
          {"width", width},
          {"height", height}};
}

ExitCode runReplay(const RenderArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  const std::vector<HeadPose> poses = readHeadPoses(arguments.poses);
  const double rate = arguments.rate == 0.0 ? PosesPerSecond : arguments.rate;
  std::vector<InputFile> inputs;
  if (common.json) {
    for (const auto& path : expanded(arguments.inputs)) inputs.push_back(inputFile(path, progress));
    inputs.push_back(inputFile(arguments.poses, progress));
  }
  ModelOfReplay model(arguments, progress.part(0.0, 0.3, "reading"));
  Scene scene;
  dress(scene, arguments);
  model.showAt(0.0, scene);
  HeadView view(scene, arguments.size.width, arguments.size.height,
                {arguments.stereo, arguments.eyeDistanceMm});
  std::optional<ReplayFilm> film;
  if (isFilm(common.output)) film.emplace(rate);
  const auto showAt = [&](double seconds) { model.showAt(seconds, scene); };
  const ReplayedHead head = replayHead(view, poses, rate, showAt, film ? &*film : nullptr,
                                       progress.part(0.3, 1.0, "replaying"));
  ExitCode code = ExitCode::Done;
  if (film) {
    OutputSet outputs;
    outputs.add(common.output);
    writeFile(common.output, film->finish(), common.existing());
    outputs.keep();
  } else {
    code = keepPicture(arguments, common, head.last);
  }
  progress.report(1.0);
  const Json report = replayReport(head.replay, rate, inputs, parametersOfReplay(arguments, rate));
  if (!common.quiet) {
    printWarnings(model.warnings());
    printWarnings(report.at("warnings").get<std::vector<std::string>>());
  }
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << common.output.string() << ": "
              << (film ? grouped(static_cast<double>(film->pictures())) + " pictures, " +
                             std::to_string(film->rate()) + " a second"
                       : std::to_string(head.last.width) + " x " +
                             std::to_string(head.last.height) + " pixels")
              << "\n"
              << replayText(report);
  }
  return code;
}

ExitCode runRender(const RenderArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  requireSpelled(arguments);
  requireUsable(arguments, common);
  if (!arguments.poses.empty()) return runReplay(arguments, common, progress);
  if (isFilm(common.output)) return writeFilm(arguments, common, progress);
  PictureDrawer drawer;
  const DrawnPicture drawn = drawer.draw(arguments, progress);
  const ExitCode code = keepPicture(arguments, common, drawn.picture);
  if (!common.quiet) {
    printWarnings(drawn.warnings);
    std::cout << common.output.string() << ": " << drawn.picture.width << " x "
              << drawn.picture.height << " pixels\n";
  }
  return code;
}

}  // namespace

Run declareRender(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<RenderArguments>();
  addDrawingArguments(app, *arguments);
  addOutput(app, common, "FILE",
            "Where the picture goes: .png; of a breath or of --pose also a film: .ogv.")
      ->required();
  app.add_option("--reference", arguments->reference, "Compare with this picture; exit 8 if over.")
      ->type_name("FILE");
  app.add_option("--diff", arguments->difference, "Write the difference from --reference here.")
      ->type_name("FILE");
  app.add_option("--pose", arguments->poses,
                 "Replay recorded head poses (CSV: time_s, x_mm, y_mm, z_mm, qw, qx, qy, qz) in "
                 "real time, offscreen, and tell latency and dropped poses; no headset is driven.")
      ->type_name("FILE");
  addJson(app, common);
  addFields(app, *arguments);
  return [arguments, &common](const Progress& progress) {
    return runRender(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
