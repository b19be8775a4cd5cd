#include <cctype>
#include <iostream>
#include <memory>
#include <sstream>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/ct_report.h"
#include "cli/files.h"
#include "cli/text.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/report.h"
#include "pipeline/split_lobes.h"

namespace pneuma::cli {
namespace {

constexpr const char* ReportName = "lobes.json";
constexpr const char* PointsName = "fissures.json";
constexpr const char* PatchFolder = "fissures";

struct LobesArguments {
  std::vector<std::filesystem::path> lungs;
  std::filesystem::path fissures;
  std::string fractions;
  std::filesystem::path ct;
  std::filesystem::path labels;
  bool snap = false;
  LobeOptions options;
  SnapOptions snapOptions;
};

LobeShares sharesOf(const std::string& text, std::size_t count) {
  LobeShares shares;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    try {
      std::size_t used = 0;
      shares.push_back(std::stod(part, &used) / 100.0);
      if (used != part.size()) shares.clear();
    } catch (const std::exception&) {
      shares.clear();
    }
    if (shares.empty()) break;
  }
  if (shares.size() == count) return shares;
  throw InvalidOption("--fractions takes RUL,RML,RLL or RUL,RML,RLL/LUL,LLL in percent, not '" +
                      text + "'");
}

/// "40.5,12.9,46.6/50,50"; "usual" for what most people have.
std::map<Side, LobeShares> fractionsOf(const std::string& text) {
  if (text.empty()) return {};
  if (text == "usual") {
    return {{Side::Right, usualShares(Side::Right)}, {Side::Left, usualShares(Side::Left)}};
  }
  const std::size_t slash = text.find('/');
  std::map<Side, LobeShares> shares;
  shares[Side::Right] = sharesOf(text.substr(0, slash), 3);
  if (slash != std::string::npos) shares[Side::Left] = sharesOf(text.substr(slash + 1), 2);
  return shares;
}

std::string lobeFile(Lobe lobe) {
  std::string name(shortName(lobe));
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name + ".vtp";
}

std::filesystem::path patchPath(const std::filesystem::path& folder, Fissure fissure) {
  return folder / PatchFolder / (std::string(shortName(fissure)) + ".vtp");
}

std::vector<std::filesystem::path> outputsOf(const std::filesystem::path& folder,
                                             const LungModel& model, bool points) {
  std::vector<std::filesystem::path> outputs = {folder / ReportName};
  for (const LobeSurface& surface : *model.surfaces) {
    if (surface.lobe != Lobe::RightLung && surface.lobe != Lobe::LeftLung) continue;
    const Side of = side(surface.lobe);
    for (const Lobe lobe : lobesOf(of)) outputs.push_back(folder / lobeFile(lobe));
    for (const Fissure fissure : fissuresOf(of)) outputs.push_back(patchPath(folder, fissure));
  }
  if (points) outputs.push_back(folder / PointsName);
  return outputs;
}

void writeAll(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& paths,
              const LobesOfLungs& lobes, const LobeInputs& inputs, const Json& report,
              const Progress& progress) {
  OutputSet outputs;
  outputs.addFolder(folder);
  outputs.addFolder(folder / PatchFolder);
  for (const auto& path : paths) outputs.add(path);
  for (const SplitLung& lung : lobes.lungs) {
    for (const Lobe lobe : lobesOf(lung.side)) {
      writeSurface(folder / lobeFile(lobe),
                   surfaceOf(lung.complex, static_cast<RegionId>(lobe)).mesh);
      progress.throwIfStopped();
    }
    for (const Fissure fissure : fissuresOf(lung.side)) {
      TriangleMarks marks;
      const auto complete = lobes.complete.find(fissure);
      if (complete != lobes.complete.end()) marks["on_fissure"] = complete->second.onSheet;
      writeSurface(patchPath(folder, fissure), fissurePatch(lung, fissure), {}, marks);
      progress.throwIfStopped();
    }
  }
  if (!inputs.given.empty()) writeFissures(folder / PointsName, inputs.given);
  writeFile(folder / ReportName, jsonText(report));
  outputs.keep();
}

LungModel openedCt(const LobesArguments& arguments, const Progress& progress) {
  CtFile file = readCt(arguments.ct, {}, progress.part(0.0, 0.8, "reading the CT"));
  if (arguments.snap) requireThinSlices(file.image);
  const InputFile input = ctInput(arguments.ct, file, progress.part(0.8, 1.0, "hashing"));
  LungModel model = modelOf(std::move(file), arguments.ct);
  model.inputs = {input};
  return model;
}

ExitCode runLobes(const LobesArguments& arguments, const CommonOptions& common,
                  const Progress& progress) {
  LobeInputs inputs;
  inputs.shares = fractionsOf(arguments.fractions);
  if (arguments.snap) {
    if (arguments.ct.empty()) throw InvalidOption("--snap needs the CT of these lungs: --ct");
    if (!inputs.shares.empty()) {
      throw InvalidOption("--fractions would move the fissures off what --snap finds; leave one");
    }
    inputs.snap = arguments.snapOptions;
  }
  requireFolderOutput(common.output);
  if (!arguments.fissures.empty()) inputs.given = readFissures(arguments.fissures);
  LungModel model = openLobes(arguments.lungs, progress.part(0.0, 0.1, "reading surfaces"));
  if (!arguments.fissures.empty()) model.inputs.push_back(inputFile(arguments.fissures));
  if (!arguments.ct.empty()) {
    const LungModel ct = openedCt(arguments, progress.part(0.1, 0.2, "reading the CT"));
    model = withCt(model, ct, arguments.labels, progress.part(0.2, 0.4, "finding lungs"));
  }
  const std::vector<std::filesystem::path> paths =
      outputsOf(common.output, model, !inputs.given.empty());
  for (const auto& path : paths) {
    std::error_code ignored;
    if (std::filesystem::exists(path.parent_path(), ignored)) {
      requireOutput(path, common.existing());
    }
    requireOtherThanInputs(path, arguments.lungs);
    for (const auto* input : {&arguments.fissures, &arguments.ct, &arguments.labels}) {
      requireOtherThanInputs(path, {input, 1});
    }
  }
  const LobesOfLungs lobes =
      splitLobes(model, inputs, arguments.options, progress.part(0.4, 0.9, "splitting lungs"));
  Json report = lobesReport(model, lobes, arguments.options);
  if (arguments.snap) report["parameters"].update(toJson(arguments.snapOptions));
  writeAll(common.output, paths, lobes, inputs, report, progress.part(0.9, 1.0, "writing"));
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
      "segment --surfaces' writes.")
      ->required();
  app.add_option("--fissures", arguments->fissures,
                 "Points upon the fissures, .json (pneuma/fissures/1) or .csv (Chest Imaging "
                 "Platform), LPS mm; a fissure without any is proposed by the lung's shape.")
      ->type_name("FILE");
  app.add_option("--fractions", arguments->fractions,
                 "Move the fissures until the lobes have these shares of their lung in percent, "
                 "RUL,RML,RLL[/LUL,LLL], or 'usual' for 40.5,12.9,46.6/50,50.")
      ->type_name("LIST");
  app.add_option("--ct", arguments->ct,
                 "The CT of these lungs, of slices up to 1.5 mm: tells how much of each fissure "
                 "shows.")
      ->type_name("CT");
  app.add_option("--labels", arguments->labels,
                 "Labels of the lungs in the CT, 10 right, 20 left; else they are found.")
      ->type_name("FILE");
  app.add_flag("--snap", arguments->snap, "Draw the fissures onto what shows of them in the CT.");
  addFields(app, arguments->options);
  addFields(app, arguments->snapOptions);
  addOutput(app, common, "FOLDER",
            "The folder for rul.vtp, rml.vtp, rll.vtp, lul.vtp, lll.vtp, fissures/*.vtp and "
            "lobes.json: what 'pneuma grow' takes.")
      ->required();
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runLobes(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
