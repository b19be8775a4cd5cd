#include <iostream>
#include <memory>
#include <optional>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/ct_file.h"
#include "io/landmark_file.h"
#include "io/volume_file.h"
#include "pipeline/estimate.h"
#include "pipeline/whole_lungs.h"

namespace pneuma::cli {
namespace {

struct EstimateArguments {
  std::vector<std::filesystem::path> lungs;
  std::vector<std::string> landmarks;  ///< one file, or two
  std::vector<std::string> scans;      ///< that landmarks are counted in; none, one or two
  std::vector<std::string> later;
  int firstVoxel = 1;
  EstimateOptions options;
};

/// Where voxels stand: of a volume by its head, of a series of slices by reading it.
ImageGeometry geometryOf(const std::filesystem::path& path, const Progress& progress) {
  return isVolumeFile(path) ? readVolumeHeader(path).geometry
                            : readCt(path, {}, progress).image.geometry;
}

std::optional<LandmarkVoxels> voxelsOf(const EstimateArguments& arguments,
                                       const Progress& progress) {
  if (arguments.scans.empty()) return std::nullopt;
  LandmarkVoxels voxels;
  voxels.first = arguments.firstVoxel;
  voxels.rest = geometryOf(arguments.scans.front(), progress.part(0.0, 0.5, "reading a scan"));
  voxels.moved =
      arguments.scans.size() == 1
          ? voxels.rest
          : geometryOf(arguments.scans.back(), progress.part(0.5, 1.0, "reading a scan"));
  return voxels;
}

std::vector<std::filesystem::path> pathsOf(const std::vector<std::string>& texts) {
  return {texts.begin(), texts.end()};
}

/// @throws InvalidOption if options speak against each other
void requireOptions(const EstimateArguments& arguments) {
  constexpr std::size_t Most = 2;
  if (arguments.landmarks.size() > Most) {
    throw InvalidOption("--landmarks takes one file, or two: at rest and moved");
  }
  if (arguments.scans.size() > Most) {
    throw InvalidOption("--voxels-of takes one scan, or two: at rest and moved");
  }
  if (arguments.landmarks.empty() && arguments.lungs.empty() && arguments.later.empty()) {
    throw InvalidOption("there is nothing to fit constants to; give landmarks (--landmarks)");
  }
}

/// Both lungs' walls, from surfaces or from an image of labels.
std::map<Side, TriangleMesh> wallsFrom(std::span<const std::filesystem::path> paths,
                                       std::vector<InputFile>& inputs,
                                       std::vector<std::string>& warnings,
                                       const Progress& progress) {
  const bool image = paths.size() == 1 && isCtPath(paths.front());
  const Progress reading = progress.part(0.0, 0.6, "reading");
  const LungModel model =
      image ? openLungs(paths, {}, reading) : openFiles(expanded(paths), reading);
  inputs.insert(inputs.end(), model.inputs.begin(), model.inputs.end());
  return lungWalls(model, warnings, progress.part(0.6, 1.0, "joining lobes"));
}

std::string errorText(const Json& errors, const char* kind) {
  const Json& error = errors.at(kind);
  return fixed(error.at("mean_mm").get<double>(), 2) + " +- " +
         fixed(error.at("sd_mm").get<double>(), 2);
}

std::string constantsText(const Json& report) {
  std::vector<std::vector<std::string>> rows = {{"constant", "value", "standard error"}};
  for (const Json& constant : report.at("constants")) {
    const Json& error = constant.at("standard_error");
    rows.push_back({constant.at("name").get<std::string>(),
                    fixed(constant.at("value").get<double>(), 3),
                    error.is_null() ? "not determined" : fixed(error.get<double>(), 3)});
  }
  return table(rows);
}

std::string errorsText(const Json& report) {
  const bool heldOut = report.at("landmarks").at("held_out").get<int>() > 0;
  std::vector<std::vector<std::string>> rows = {{"error, mm", "fitted", "shift out"}};
  if (heldOut) rows.front().insert(rows.front().end(), {"held out", "shift out"});
  for (const Json& row : report.at("errors")) {
    const Json& fitted = row.at("fitted");
    rows.push_back({row.at("motion").get<std::string>(), errorText(fitted, "raw"),
                    errorText(fitted, "shift_taken_out")});
    if (!heldOut) continue;
    const Json& others = row.at("held_out");
    rows.back().push_back(errorText(others, "raw"));
    rows.back().push_back(errorText(others, "shift_taken_out"));
  }
  return table(rows);
}

std::string surfacesText(const Json& report) {
  if (report.at("surfaces").empty()) return "";
  std::vector<std::vector<std::string>> rows = {
      {"wall to later surface, mm", "lung", "no motion", "these constants"}};
  for (const Json& row : report.at("surfaces")) {
    rows.push_back({std::to_string(row.at("later").get<int>()), row.at("lung").get<std::string>(),
                    fixed(row.at("still_mm").get<double>(), 2),
                    fixed(row.at("fitted_mm").get<double>(), 2)});
  }
  return table(rows);
}

std::string summary(const Json& report, const std::filesystem::path& output) {
  const Json& landmarks = report.at("landmarks");
  const auto count = [&](const char* which) {
    return std::to_string(landmarks.at(which).get<std::size_t>());
  };
  std::string text = (output.empty() ? "" : output.string() + ": ") + "form '" +
                     report.at("form").get<std::string>() + "' fitted to " + count("fitted") +
                     " landmarks, " + count("held_out") + " held out\n";
  return text + constantsText(report) + errorsText(report) + surfacesText(report) +
         report.at("basis").get<std::string>() + "\n" + failedChecks(report);
}

ExitCode runEstimate(const EstimateArguments& arguments, const CommonOptions& common,
                     const Progress& progress) {
  requireOptions(arguments);
  if (!common.output.empty()) {
    if (common.output.extension() != ".json") {
      throw Unsupported("constants are written as JSON; '" + common.output.string() +
                        "' should end in .json");
    }
    requireOutput(common.output, common.existing());
  }
  const std::vector<std::filesystem::path> landmarks = pathsOf(arguments.landmarks);
  requireOtherThanInputs(common.output, landmarks);
  std::vector<InputFile> inputs;
  EstimateInput input;
  if (!landmarks.empty()) {
    input.landmarks = readLandmarkPairs(
        landmarks, voxelsOf(arguments, progress.part(0.0, 0.1, "reading landmarks")));
    for (const auto& file : landmarks) inputs.push_back(inputFile(file));
  }
  std::vector<std::string> warnings;
  if (!arguments.lungs.empty()) {
    input.rest =
        wallsFrom(arguments.lungs, inputs, warnings, progress.part(0.1, 0.3, "lungs at rest"));
  }
  for (const std::filesystem::path& later : pathsOf(arguments.later)) {
    input.later.push_back(
        wallsFrom({&later, 1}, inputs, warnings, progress.part(0.3, 0.5, "later lungs")));
  }
  MotionEstimate estimate =
      estimateMotion(input, arguments.options, progress.part(0.5, 1.0, "fitting"));
  estimate.warnings.insert(estimate.warnings.begin(), warnings.begin(), warnings.end());
  const Json report = estimateReport(inputs, arguments.options, estimate);
  if (!common.output.empty()) writeFile(common.output, jsonText(report), common.existing());
  if (!common.quiet) printWarnings(estimate.warnings);
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet || common.output.empty()) {
    std::cout << summary(report, common.output);
  }
  return failedChecks(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareEstimate(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<EstimateArguments>();
  addFiles(app, "LUNGS", arguments->lungs,
           "Surfaces of the lungs or of their lobes at the end of expiration, a folder of them, or "
           "an image of labels. Without them, boxes are those of the landmarks.");
  addRepeatable(app, "--landmarks", arguments->landmarks, "FILE",
                "Places that were found again: a CSV with columns exp_x, exp_y, exp_z, insp_x, "
                "insp_y, insp_z (mm, LPS), lines of six numbers, or, given twice, a file of places "
                "at rest and one of moved places, with three numbers in a line.");
  CLI::Option* scans = addRepeatable(
      app, "--voxels-of", arguments->scans, "CT",
      "Landmarks are voxels of this scan; given twice, of one at rest and one breathed in.");
  app.add_option("--first-voxel", arguments->firstVoxel,
                 "Number of a scan's first voxel: 1 as in DIR-Lab's files, or 0.")
      ->type_name("{0|1}")
      ->check(CLI::Range(0, 1))
      ->default_str("1")
      ->needs(scans);
  addRepeatable(app, "--later", arguments->later, "LUNGS",
                "The same lungs breathed in, as LUNGS. May be repeated, in the order of rising "
                "volumes; landmarks moved to the last one.");
  addFields(app, arguments->options);
  app.get_option("--every")->excludes(app.get_option("--hold-out"));
  addOutput(app, common, "FILE",
            "The constants and what they are worth (.json), for 'pneuma breathe --constants'.");
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runEstimate(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
