#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/ct_report.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/atomic_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/lobe_files.h"
#include "pipeline/lobe_labels.h"
#include "pipeline/lobe_shares.h"
#include "pipeline/report.h"
#include "pipeline/split_lobes.h"
#include "pipeline/whole_lungs.h"

namespace pneuma::cli {
namespace {

constexpr double LabelMm = 1.0;  ///< voxels of labels where there is no image

struct LobesArguments {
  std::vector<std::filesystem::path> lungs;
  std::filesystem::path fissures;
  std::filesystem::path planes;
  std::string fractions;
  LungLabelOptions numbers;
  std::filesystem::path ct;
  SeriesChoice series;
  CtCorrections corrections;
  std::filesystem::path labels;
  bool snap = false;
  LobeOptions options;
  SnapOptions snapOptions;
};

LungModel openedCt(const LobesArguments& arguments, const Progress& progress) {
  CtFile file = readCt(arguments.ct, arguments.corrections,
                       progress.part(0.0, 0.8, "reading the CT"), arguments.series);
  if (arguments.snap) requireThinSlices(file.image);
  const InputFile input = ctInput(arguments.ct, file, progress.part(0.8, 1.0, "hashing"));
  LungModel model = modelOf(std::move(file),
                            {arguments.ct, arguments.corrections, arguments.series.wanted, 0, {}});
  model.inputs = {input};
  return model;
}

ExitCode runLobes(const LobesArguments& arguments, const CommonOptions& common,
                  const Progress& progress) {
  LobeInputs inputs;
  inputs.shares = lobeSharesOfText(arguments.fractions);
  if (arguments.snap) {
    if (!inputs.shares.empty()) {
      throw InvalidOption("--fractions would move the fissures off what --snap finds; leave one");
    }
    inputs.snap = arguments.snapOptions;
  }
  requireFolderOutput(common.output);
  const std::filesystem::path& given =
      arguments.planes.empty() ? arguments.fissures : arguments.planes;
  FissureFile file;
  if (!arguments.fissures.empty()) file = readFissureFile(given);
  if (!arguments.planes.empty()) file.fissures = readPlanes(given);
  inputs.given = file.fissures;
  inputs.accessory = file.accessory;
  LungModel model =
      openLungs(arguments.lungs, arguments.numbers, progress.part(0.0, 0.3, "reading lungs"));
  std::vector<std::filesystem::path> givenFiles = patchFiles(file);
  if (!given.empty()) givenFiles.push_back(given);
  for (const auto& path : givenFiles) model.inputs.push_back(inputFile(path));
  if (!arguments.ct.empty()) {
    const LungModel ct = openedCt(arguments, progress.part(0.3, 0.35, "reading the CT"));
    model = withCt(model, ct, arguments.labels, progress.part(0.35, 0.4, "finding lungs"));
    givenFiles.push_back(arguments.ct);
    if (!arguments.labels.empty()) givenFiles.push_back(arguments.labels);
  }
  if (arguments.snap && !model.ct) {
    throw InvalidOption("--snap needs the CT of these lungs: --ct");
  }
  std::vector<std::filesystem::path> paths;
  for (const auto& output : lobeOutputs(model, inputs)) paths.push_back(common.output / output);
  for (const auto& path : paths) {
    std::error_code ignored;
    if (std::filesystem::exists(path.parent_path(), ignored)) {
      requireOutput(path, common.existing());
    }
    requireOtherThanInputs(path, arguments.lungs);
    requireOtherThanInputs(path, givenFiles);
  }
  const LobesOfLungs lobes =
      splitLobes(model, inputs, arguments.options, progress.part(0.4, 0.85, "splitting lungs"));
  const Progress writing = progress.part(0.85, 1.0, "writing");
  const LabelImage labels = lobeLabels(
      model.labels ? *model.labels : lungLabels(model, LabelMm, writing), lobes, writing);
  Json report = lobesReport(model, lobes, arguments.options);
  if (arguments.snap) report["parameters"].update(toJson(arguments.snapOptions));
  OutputSet outputs;
  outputs.addFolder(common.output);
  for (const auto& path : paths) outputs.addFolder(path.parent_path());
  for (const auto& path : paths) outputs.add(path);
  writeLobes(common.output, lobes, labels, inputs, report, writing);
  outputs.keep();
  progress.report(1.0);
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << lobesText(lobes) << failedChecks(report);
  }
  return failedChecks(report).empty() ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace

Run declareLobes(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<LobesArguments>();
  addFiles(
      app, "LUNGS", arguments->lungs,
      "Closed surfaces of whole lungs, named right and left, or a folder of them: what 'pneuma "
      "segment --surfaces' writes; surfaces of lobes, which are joined to lungs first; an image of "
      "labels; or a CT.")
      ->required();
  CLI::Option* fissures =
      app.add_option(
             "--fissures", arguments->fissures,
             "The fissures: points, planes, equations or surfaces in .json (pneuma/fissures/1), "
             "points in .mrk.json or .fcsv (3D Slicer) or .csv (Chest Imaging Platform); "
             "one that is not there is proposed by the lung's shape.")
          ->type_name("FILE");
  app.add_option("--planes", arguments->planes,
                 "The same from a .json file that has planes and nothing else.")
      ->type_name("FILE")
      ->excludes(fissures);
  app.add_option("--fractions", arguments->fractions,
                 "Move the fissures until the lobes have these shares of their lung in percent, "
                 "RUL,RML,RLL[/LUL,LLL], or 'usual' for 40.5,12.9,46.6/50,50.")
      ->type_name("LIST");
  addFields(app, arguments->numbers);
  app.add_option("--ct", arguments->ct,
                 "The CT of these lungs, of slices up to 1.5 mm: tells how much of each fissure "
                 "shows.")
      ->type_name("CT");
  app.add_option("--series", arguments->series.wanted,
                 "The series of --ct to take: its place in the list of 'pneuma info', its UID, or "
                 "its name in a project; "
                 "else the best.")
      ->type_name("N|UID");
  addCorrections(app, arguments->corrections);
  app.add_option("--labels", arguments->labels,
                 "Labels of the lungs in the CT, 10 right, 20 left; else they are found.")
      ->type_name("FILE");
  app.add_flag("--snap", arguments->snap, "Draw the fissures onto what shows of them in the CT.");
  addFields(app, arguments->options);
  addFields(app, arguments->snapOptions);
  addOutput(app, common, "FOLDER",
            "The folder for rul.vtp, rml.vtp, rll.vtp, lul.vtp, lll.vtp, fissures/*.vtp, lobes.vtm "
            "(all of them for ParaView), labels.nii.gz and lobes.json: what 'pneuma grow' takes.")
      ->required();
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runLobes(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
