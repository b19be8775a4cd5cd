#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/ct_report.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/ct_file.h"
#include "io/volume_file.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

struct ImportArguments {
  std::filesystem::path input;
  SeriesChoice series;
  CtCorrections corrections;
};

Json importReport(const ImportArguments& arguments, const CtFile& file,
                  const std::filesystem::path& output, const Progress& progress) {
  const std::vector<InputFile> inputs = {ctInput(arguments.input, file, progress)};
  Json report = reportEnvelope("pneuma/import/1", inputs, toJson(arguments.corrections), 0);
  report["output"] = output.string();
  report["ct"] = {{"path", arguments.input.string()}};
  report["ct"].update(ctJson(file, false));
  report["warnings"] = file.warnings;
  return report;
}

ExitCode runImport(const ImportArguments& arguments, const CommonOptions& common,
                   const Progress& progress) {
  requireVolumeOutput(common.output, common.existing());
  requireOtherThanInputs(common.output, {&arguments.input, 1});
  const CtFile file = readCt(arguments.input, arguments.corrections,
                             progress.part(0.0, 0.6, "reading"), arguments.series);
  Json report;
  if (common.json) {
    report = importReport(arguments, file, common.output, progress.part(0.6, 0.7, "hashing"));
  }
  progress.part(0.7, 1.0, "writing").report(0.0);
  writeVolume(common.output, file.image, common.existing());
  progress.report(1.0);
  if (!common.quiet) printWarnings(file.warnings);
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << common.output.string() << ": "
              << (file.series ? titleOf(*file.series) : file.format) << "\n"
              << ctText(file, false);
  }
  return ExitCode::Done;
}

}  // namespace

Run declareImport(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<ImportArguments>();
  app.add_option("CT", arguments->input,
                 "A folder of DICOM files, one of them, a zip archive, or a volume file.")
      ->type_name("PATH")
      ->required();
  addOutput(app, common, "FILE", "Where the CT goes: .nii.gz, .nii, .nrrd or .mha.")->required();
  app.add_option("--series", arguments->series.wanted,
                 "The series to take: its place in the list of 'pneuma info', its UID, or its name "
                 "in a project; else the "
                 "best.")
      ->type_name("N|UID");
  addCorrections(app, arguments->corrections);
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runImport(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
