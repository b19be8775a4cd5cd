#include <chrono>
#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/ct_report.h"
#include "cli/files.h"
#include "cli/text.h"
#include "core/seconds.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/lung_edits_file.h"
#include "pipeline/report.h"
#include "pipeline/segment_report.h"
#include "pipeline/stage_needs.h"

namespace pneuma::cli {
namespace {

struct SegmentArguments {
  std::filesystem::path input;
  SeriesChoice series;
  CtCorrections corrections;
  LungOptions lungs;
  SurfaceOptions surfaceOptions;
  std::filesystem::path edits;     ///< may be empty
  std::filesystem::path surfaces;  ///< folder; may be empty
  std::filesystem::path central;   ///< may be empty
  std::filesystem::path report;    ///< may be empty
  bool strict = false;
};

std::filesystem::path surfacePath(const SegmentArguments& arguments, const LobeSurface& surface) {
  return arguments.surfaces / (surface.name + ".vtp");
}

void requireUsable(const SegmentArguments& arguments, const CommonOptions& common) {
  if (!common.output.empty()) requireVolumeOutput(common.output, common.existing());
  if (!arguments.central.empty()) requireTreeOutput(arguments.central, common.existing());
  if (!arguments.report.empty()) requireOutput(arguments.report, common.existing());
  for (const auto& output : {common.output, arguments.central, arguments.report}) {
    requireOtherThanInputs(output, {&arguments.input, 1});
    if (!arguments.edits.empty()) requireOtherThanInputs(output, {&arguments.edits, 1});
  }
  if (arguments.surfaces.empty()) return;
  requireFolderOutput(arguments.surfaces);
  std::error_code error;
  for (const char* name : {"right.vtp", "left.vtp"}) {
    if (std::filesystem::exists(arguments.surfaces, error)) {
      requireSurfaceOutput(arguments.surfaces / name, common.existing());
    }
  }
}

void writeAll(const SegmentArguments& arguments, const CommonOptions& common,
              const LungModel& model, const Json& report, const Progress& progress) {
  OutputSet outputs;
  if (!common.output.empty()) {
    outputs.add(common.output);
    writeVolume(common.output, *model.labels, common.existing());
    progress.report(0.6);
  }
  if (!arguments.surfaces.empty()) {
    outputs.addFolder(arguments.surfaces);
    for (const LobeSurface& surface : *model.surfaces) {
      outputs.add(surfacePath(arguments, surface));
      writeSurface(surfacePath(arguments, surface), *surface.mesh);
      progress.report(0.8);
    }
  }
  if (!arguments.central.empty() && model.central) {
    outputs.add(arguments.central);
    writeTree(arguments.central, *model.central,
              {{"method", "measured in a CT"}, {"version", versionText()}});
  }
  if (!arguments.report.empty()) {
    outputs.add(arguments.report);
    writeFile(arguments.report, jsonText(report), common.existing());
  }
  outputs.keep();
}

ExitCode runSegment(const SegmentArguments& arguments, const CommonOptions& common,
                    const Progress& progress) {
  requireUsable(arguments, common);
  std::vector<LungEdit> edits;
  if (!arguments.edits.empty()) edits = readLungEdits(arguments.edits);
  const auto start = std::chrono::steady_clock::now();
  const CtHead head =
      readCtHead(arguments.input, arguments.series, progress.part(0.0, 0.02, "reading headers"));
  requireStageFits("segment", "finding the lungs", head.geometry, arguments.corrections.resampleMm);
  CtFile file = readCt(arguments.input, arguments.corrections, progress.part(0.02, 0.15, "reading"),
                       head.choice);
  std::vector<InputFile> inputs;
  if (common.json || !arguments.report.empty()) {
    inputs.push_back(ctInput(arguments.input, file, progress.part(0.15, 0.2, "hashing")));
    if (!arguments.edits.empty()) inputs.push_back(inputFile(arguments.edits));
  }
  requireWithin(edits, file.image.geometry, arguments.edits);
  LungModel model = modelOf(
      std::move(file), {arguments.input, arguments.corrections, arguments.series.wanted, 0, {}});
  model.inputs = std::move(inputs);
  const double readSeconds = secondsSince(start);
  model = withLungs(model, arguments.lungs, progress.part(0.2, 0.7, "finding the lungs"));
  model = withLungEdits(model, edits, arguments.edits, arguments.lungs.thresholdHu,
                        progress.part(0.7, 0.8, "correcting the lungs"));
  if (!arguments.surfaces.empty()) {
    model =
        withSurfaces(model, arguments.surfaceOptions, progress.part(0.8, 0.9, "drawing surfaces"));
  }
  Json report =
      segmentReport(model, arguments.lungs, readSeconds, secondsSince(start) - readSeconds);
  if (!arguments.central.empty() && !model.central) {
    report["warnings"].push_back("no airways were found, so that " + arguments.central.string() +
                                 " was not written");
  }
  writeAll(arguments, common, model, report, progress.part(0.9, 1.0, "writing"));
  progress.report(1.0);
  const auto warnings = report.at("warnings").get<std::vector<std::string>>();
  if (!common.quiet) printWarnings(warnings);
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << lungsText(model);
  }
  return arguments.strict && !warnings.empty() ? ExitCode::CheckFailed : ExitCode::Done;
}

}  // namespace

Run declareSegment(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<SegmentArguments>();
  app.add_option("CT", arguments->input,
                 "A folder of DICOM files, one of them, a zip archive, or a volume file.")
      ->type_name("PATH")
      ->required();
  addOutput(app, common, "FILE",
            "Write the labels here, .nii.gz, .nii, .nrrd or .mha: 10 right lung, 20 left lung, 6 "
            "trachea and bronchi.");
  app.add_option("--surfaces", arguments->surfaces,
                 "Write right.vtp and left.vtp into this folder: closed surfaces to grow in.")
      ->type_name("FOLDER");
  app.add_option("--central", arguments->central,
                 "Write the airways here, .vtp, .swc, .csv or .json: the --central of grow.")
      ->type_name("FILE");
  app.add_option("--edits", arguments->edits,
                 "Correct the lungs by these strokes and seeds, JSON as the window saves it "
                 "(docs/lung-edits.md).")
      ->type_name("FILE");
  app.add_option("--report", arguments->report, "Write the JSON report here.")->type_name("FILE");
  app.add_option("--series", arguments->series.wanted,
                 "The series to take: its place in the list of 'pneuma info', its UID, or its name "
                 "in a project; else the "
                 "best.")
      ->type_name("N|UID");
  addCorrections(app, arguments->corrections);
  addFields(app, arguments->lungs);
  addFields(app, arguments->surfaceOptions);
  app.add_flag("--strict", arguments->strict, "End with 7 if there is a warning.");
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runSegment(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
