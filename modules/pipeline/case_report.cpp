#include "pipeline/case_report.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/case_methods.h"
#include "pipeline/figure_table.h"
#include "pipeline/report.h"
#include "pipeline/segment_report.h"
#include "pipeline/tree_measurement.h"

namespace pneuma {
namespace {

/// Checks of all stages with one form: "of", "id", "value", "low", "high", "unit", "ok".
class Checks {
 public:
  void add(std::string_view of, const Json& checks) {
    for (const Json& check : checks) {
      const bool oneSided = check.contains("limit");
      list_.push_back({{"of", of},
                       {"id", check.at("id")},
                       {"value", check.at("value")},
                       {"low", oneSided ? Json() : check.at("low")},
                       {"high", oneSided ? check.at("limit") : check.at("high")},
                       {"unit", check.value("unit", "")},
                       {"ok", check.at("ok")}});
    }
  }

  const Json& list() const { return list_; }

 private:
  Json list_ = Json::array();
};

Json volumesOf(const LungModel& model) {
  std::map<Side, double> ofSide;
  double all = 0.0;
  for (const LobeSurface& surface : *model.surfaces) {
    ofSide[side(surface.lobe)] += surface.health.volumeMl;
    all += surface.health.volumeMl;
  }
  Json volumes = Json::array();
  for (const LobeSurface& surface : *model.surfaces) {
    const double ml = surface.health.volumeMl;
    volumes.push_back({{"region", longName(surface.lobe)},
                       {"ml", ml},
                       {"share_of_lung", ml / ofSide.at(side(surface.lobe))},
                       {"share_of_all", ml / all}});
  }
  if (volumes.size() > 1) {
    volumes.push_back(
        {{"region", "together"}, {"ml", all}, {"share_of_lung", Json()}, {"share_of_all", 1.0}});
  }
  return volumes;
}

Json surfaceChecks(const LungModel& model) {
  Json checks = Json::array();
  for (const LobeSurface& surface : *model.surfaces) {
    const bool closed = surface.health.fitToGrow();
    checks.push_back({{"id", "CLOSED-" + std::string(shortName(surface.lobe))},
                      {"value", closed ? 0 : 1},
                      {"limit", 0},
                      {"ok", closed}});
  }
  return checks;
}

/// Lines of the table of morphometry that are known, each with its published band.
Json figuresOf(const Json& morphometry) {
  Json figures = Json::array();
  for (const FigureLine& line : morphometryLines()) {
    const std::optional<double> value = meanOf(figureAt(morphometry, line.key));
    if (!value) continue;
    const std::vector<std::string> band = bandText(line);
    figures.push_back({{"figure", line.label},
                       {"value", *value},
                       {"text", fixed(*value, line.decimals)},
                       {"published", band.empty() ? "" : band.front()},
                       {"source", band.empty() ? "" : band.back()}});
  }
  return figures;
}

Json breathOf(const Json& report) {
  Json breath = {{"scenario", report.at("scenario")}, {"basis", report.at("basis")}};
  breath.update(report.at("breath"));
  breath["lungs"] = report.at("lungs");
  if (report.contains("pleural_gap")) breath["pleural_gap"] = report.at("pleural_gap");
  return breath;
}

/// The regions of what a tree was grown in, whether the model comes from a file, which does not
/// keep them, or from the growth itself.
LungModel withGrownRegions(LungModel model) {
  if (!model.surfaces) return model;  // a built-in organ has its own
  const bool fit = std::ranges::all_of(
      *model.surfaces, [](const LobeSurface& surface) { return surface.health.fitToGrow(); });
  if (!model.growth || !fit) {
    model.regions = nullptr;
  } else if (!model.regions) {
    model.regions = readyToGrow(model).regions;
  }
  return model;
}

/// The files that it was made from, as far as their hashes are known.
std::vector<InputFile> inputsOf(const LungModel& model) {
  std::vector<InputFile> inputs = model.inputs;
  if (model.ctSource && !model.ctSource->sha256.empty()) {
    const std::string name = model.ctSource->path.filename().string();
    std::erase_if(inputs, [&](const InputFile& input) {
      return std::filesystem::path(input.path).filename() == name;
    });
    inputs.insert(inputs.begin(), {model.ctSource->path.string(), model.ctSource->sha256});
  }
  std::erase_if(inputs, [](const InputFile& input) { return input.sha256.empty(); });
  return inputs;
}

/// `text` without a name, wherever it stands.
std::string without(std::string text, const std::string& name, const std::string& instead) {
  for (std::size_t at = text.find(name); !name.empty() && at != std::string::npos;
       at = text.find(name, at + instead.size())) {
    text.replace(at, name.size(), instead);
  }
  return text;
}

/// Of reading and finding, of splitting and of growing.
std::vector<std::string> warningsOf(const LungModel& model) {
  std::vector<std::string> warnings = model.warnings;
  const auto add = [&](const std::vector<std::string>& some) {
    for (const std::string& sentence : some) {
      if (std::ranges::find(warnings, sentence) == warnings.end()) warnings.push_back(sentence);
    }
  };
  if (model.lobes) add(model.lobes->warnings);
  if (model.growth) add(model.growth->result.warnings);
  return warnings;
}

}  // namespace

void hideFileNames(Json& report) {
  std::size_t number = 0;
  for (Json& input : report["inputs"]) {
    const std::filesystem::path path = input.at("path").get<std::string>();
    const std::string instead = "file " + std::to_string(++number);
    for (Json& warning : report["warnings"]) {
      warning = without(without(warning.get<std::string>(), path.string(), instead),
                        path.filename().string(), instead);
    }
    input["path"] = instead;
  }
}

Json caseReport(const Project& project, const CaseReportOptions& options,
                const Progress& progress) {
  const ProjectState& state = project.state;
  const LungModel& model = state.model;
  const std::shared_ptr<const AirwayTree> tree = treeOf(model);
  const bool surfaces = model.surfaces && !model.surfaces->empty();
  if (!surfaces && !model.lungs && !tree) {
    throw InvalidInput(
        "there is nothing to report: neither surfaces nor airways, and no lungs were found in a "
        "CT; do one of the steps before");
  }
  Json parameters = Json::object();
  if (model.lungs) parameters["lungs"] = toJson(state.lungOptions);
  if (model.growth) {
    parameters["growth"] =
        std::visit([](const auto& o) { return toJson(o); }, model.growth->options);
  }
  if (state.breath) parameters["breathing"] = toJson(*state.breath);
  Json report = reportEnvelope("pneuma/case/1", inputsOf(model), std::move(parameters),
                               model.growth ? seedOf(model.growth->options) : options.seed);
  report["case"] = state.name;
  Checks checks;
  if (model.lungs) {
    const Json lungs = segmentReport(model, state.lungOptions, 0.0, 0.0);
    checks.add("lungs", lungs.at("checks"));
    report["lungs"] = lungs.at("lungs");
    progress.throwIfStopped();
  }
  if (surfaces) {
    report["volumes"] = volumesOf(model);
    checks.add("surfaces", surfaceChecks(model));
    progress.throwIfStopped();
  }
  if (model.lobes) {
    checks.add("lobes", lobesReport(model, *model.lobes, state.splitEdits.options).at("checks"));
    progress.throwIfStopped();
  }
  if (tree) {
    const LungModel grown = withGrownRegions(model);
    const TreeMeasurement measured =
        measureTree(*tree, grown, options.seed, progress.part(0.0, 0.6, "measuring"));
    const Json json = toJson(measured);
    report["airways"] = {{"branches", json.at("branches")},
                         {"terminals", json.at("terminals")},
                         {"figures", figuresOf(json.at("morphometry"))}};
    checks.add("airways", checksOf(measured));
  }
  report["warnings"] = warningsOf(model);
  if (state.breath && surfaces) {
    const BreathingLungs lungs =
        breathe(model, *state.breath, progress.part(0.6, 1.0, "breathing"));
    const Json breath = breatheReport(model, lungs, *state.breath);
    report["breathing"] = breathOf(breath);
    checks.add("breathing", breath.at("checks"));
    for (const Json& warning : breath.at("warnings")) report["warnings"].push_back(warning);
  }
  report["checks"] = checks.list();
  const CaseMethods methods = methodsOf(state);
  report["methods"] = methods.paragraph;
  report["references"] = methods.references;
  if (!options.identify) {
    hideFileNames(report);
    for (Json& input : report["inputs"]) input.erase("path");
    report["case"] = Json();
  }
  progress.report(1.0);
  return report;
}

}  // namespace pneuma
