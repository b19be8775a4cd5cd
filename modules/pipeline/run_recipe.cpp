#include "pipeline/run_recipe.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/seconds.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/measure_report.h"
#include "pipeline/report.h"
#include "pipeline/segment_report.h"
#include "pipeline/tree_measurement.h"

namespace pneuma {
namespace {

constexpr std::string_view StateSchema = "pneuma/run/1";

std::string name(Stage stage) {
  return std::string(choices(Stage{})[static_cast<std::size_t>(stage)]);
}

/// One hash of a file, or of all files below a folder with their names.
std::string contentHash(const std::filesystem::path& path, const Progress& progress) {
  if (!std::filesystem::is_directory(path)) return sha256(readFile(path));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::string all;
  for (std::size_t n = 0; n < files.size(); ++n) {
    all += std::filesystem::relative(files[n], path).string() + "\n" + sha256(readFile(files[n]));
    progress.report(static_cast<double>(n + 1) / static_cast<double>(files.size()));
  }
  return sha256(all);
}

class Runner {
 public:
  Runner(const Recipe& recipe, const RunOptions& options) : recipe_(recipe), options_(options) {
    try {
      const auto state = options.folder / run_files::State;
      if (std::filesystem::exists(state)) before_ = Json::parse(readFile(state));
      if (!before_.is_object() || before_.value("schema", "") != StateSchema) before_ = nullptr;
    } catch (const Json::exception&) {
      before_ = nullptr;  // a state that cannot be read keeps nothing
    }
    state_ = {{"schema", StateSchema}, {"stages", Json::object()}};
  }

  std::vector<StageResult> run(const Progress& progress) {
    std::vector<StageResult> results;
    results.push_back(open(progress.part(0.0, 0.2, "reading the CT")));
    results.push_back(lungs(progress.part(0.2, 0.6, "finding the lungs")));
    results.push_back(airways(progress.part(0.6, 0.95, "growing")));
    results.push_back(exportTree(progress.part(0.95, 1.0, "exporting")));
    progress.report(1.0);
    return results;
  }

 private:
  bool asked(Stage stage) const { return stage <= options_.upTo; }

  /// True if a stage was done before with the same key and its files are untouched.
  bool isKept(Stage stage, const std::string& key) const {
    if (options_.anew && stage >= options_.from) return false;
    if (before_.is_null() || !before_.at("stages").contains(name(stage))) return false;
    const Json& entry = before_.at("stages").at(name(stage));
    if (entry.value("key", "") != key || !entry.contains("files")) return false;
    for (const auto& [file, hash] : entry.at("files").items()) {
      const auto path = options_.folder / file;
      if (!std::filesystem::is_regular_file(path) || sha256(readFile(path)) != hash) return false;
    }
    return true;
  }

  /// Writes down what a stage left; everything after it counts as not done.
  void remember(const StageResult& result, const std::string& key) {
    Json entry = {{"key", key}, {"files", Json::object()}, {"warnings", result.warnings}};
    for (const std::string& file : result.files) {
      entry["files"][file] = sha256(readFile(options_.folder / file));
    }
    state_["stages"][name(result.stage)] = std::move(entry);
    writeFile(options_.folder / run_files::State, state_.dump(2) + "\n");
  }

  StageResult kept(Stage stage) {
    const Json& entry = before_.at("stages").at(name(stage));
    state_["stages"][name(stage)] = entry;
    StageResult result{stage, StageState::Kept, 0.0, {}, {}};
    for (const auto& [file, hash] : entry.at("files").items()) result.files.push_back(file);
    result.warnings = entry.value("warnings", std::vector<std::string>{});
    return result;
  }

  std::filesystem::path in(const std::string& file) const { return options_.folder / file; }

  StageResult open(const Progress& progress) {
    StageResult result{Stage::Open, StageState::NotAsked, 0.0, {}, {}};
    const auto start = std::chrono::steady_clock::now();
    openKey_ = sha256(contentHash(recipe_.ct, progress.part(0.0, 0.3, "reading the CT")) +
                      toJson(recipe_.corrections).dump() + recipe_.series.wanted + versionText() +
                      commitText());
    lungsKey_ = sha256(openKey_ + toJson(recipe_.lungs).dump() + toJson(recipe_.surfaces).dump());
    lungsKept_ = asked(Stage::Lungs) && isKept(Stage::Lungs, lungsKey_);
    result.state = lungsKept_        ? StageState::Kept
                   : options_.dryRun ? StageState::Planned
                                     : StageState::Done;
    if (lungsKept_ || options_.dryRun) return result;
    CtFile file = readCt(recipe_.ct, recipe_.corrections, progress.part(0.3, 1.0, "reading the CT"),
                         recipe_.series);
    result.warnings = file.warnings;
    model_ = modelOf(std::move(file), recipe_.ct);
    model_.inputs = {{recipe_.ct.string(), openKey_}};
    result.seconds = secondsSince(start);
    return result;
  }

  StageResult lungs(const Progress& progress) {
    if (!asked(Stage::Lungs)) return {Stage::Lungs, StageState::NotAsked, 0.0, {}, {}};
    if (lungsKept_) return kept(Stage::Lungs);
    upstreamChanged_ = true;
    StageResult result{Stage::Lungs, StageState::Planned, 0.0, {}, {}};
    if (options_.dryRun) return result;
    const auto start = std::chrono::steady_clock::now();
    std::filesystem::create_directories(options_.folder);
    const std::size_t before = model_.warnings.size();
    model_ = withLungs(model_, recipe_.lungs, progress.part(0.0, 0.8, "finding the lungs"));
    model_ = withSurfaces(model_, recipe_.surfaces, progress.part(0.8, 0.9, "drawing surfaces"));
    result.warnings.assign(model_.warnings.begin() + static_cast<std::ptrdiff_t>(before),
                           model_.warnings.end());
    writeVolume(in(run_files::Labels), *model_.labels);
    result.files.emplace_back(run_files::Labels);
    for (const LobeSurface& surface : *model_.surfaces) {
      writeSurface(in(surface.name + ".vtp"), *surface.mesh);
      result.files.emplace_back(surface.name + ".vtp");
      progress.report(0.95);
    }
    if (model_.central) {
      writeTree(in(run_files::Central), *model_.central,
                {{"method", "measured in a CT"}, {"version", versionText()}});
      result.files.emplace_back(run_files::Central);
    }
    result.seconds = secondsSince(start);
    const Json report = segmentReport(model_, recipe_.lungs, 0.0, result.seconds);
    writeFile(in(run_files::Lungs), report.dump(2) + "\n");
    result.files.emplace_back(run_files::Lungs);
    result.state = StageState::Done;
    remember(result, lungsKey_);
    return result;
  }

  StageResult airways(const Progress& progress) {
    if (!recipe_.grow || !asked(Stage::Airways)) {
      return {Stage::Airways, StageState::NotAsked, 0.0, {}, {}};
    }
    const std::string options =
        std::visit([](const auto& chosen) { return toJson(chosen).dump(); }, recipe_.growth);
    airwaysKey_ = sha256(lungsKey_ + std::string(growthMethod(recipe_.growth).name) + options);
    if (!upstreamChanged_ && isKept(Stage::Airways, airwaysKey_)) return kept(Stage::Airways);
    upstreamChanged_ = true;
    StageResult result{Stage::Airways, StageState::Planned, 0.0, {}, {}};
    if (options_.dryRun) return result;
    const auto start = std::chrono::steady_clock::now();
    // The lungs as their files have them, whether they were found now or before.
    const std::vector<std::filesystem::path> surfaces = surfaceFiles();
    LungModel model = openLobes(surfaces, progress.part(0.0, 0.2, "reading surfaces"));
    if (lungsLeft(run_files::Central)) {
      model = withCentral(model, in(run_files::Central));
    }
    model = pneuma::grow(model, recipe_.growth, progress.part(0.2, 0.9, "growing"));
    const TreeMeasurement measured = measureTree(*treeOf(model), model, seedOf(recipe_.growth),
                                                 progress.part(0.9, 1.0, "measuring"));
    writeTree(in(run_files::Tree), model.growth->result.tree, treeMetadata(model));
    result.files.emplace_back(run_files::Tree);
    result.seconds = secondsSince(start);
    writeFile(in(run_files::Growth),
              growthReport(model, measured.whole, measured.byLobe, 0.0, 0.0).dump(2) + "\n");
    result.files.emplace_back(run_files::Growth);
    result.warnings = model.warnings;
    result.state = StageState::Done;
    remember(result, airwaysKey_);
    return result;
  }

  StageResult exportTree(const Progress& progress) {
    if (recipe_.formats.empty() || !recipe_.grow || !asked(Stage::Export)) {
      return {Stage::Export, StageState::NotAsked, 0.0, {}, {}};
    }
    std::string key = airwaysKey_;
    for (const std::string& format : recipe_.formats) key += format;
    key = sha256(key);
    if (!upstreamChanged_ && isKept(Stage::Export, key)) return kept(Stage::Export);
    StageResult result{Stage::Export, StageState::Planned, 0.0, {}, {}};
    if (options_.dryRun) return result;
    const auto start = std::chrono::steady_clock::now();
    const TreeFile tree = readTree(in(run_files::Tree));
    for (const std::string& format : recipe_.formats) {
      writeTree(in("tree." + format), tree.tree, tree.metadata);
      result.files.emplace_back("tree." + format);
      progress.throwIfStopped();
    }
    result.seconds = secondsSince(start);
    result.state = StageState::Done;
    remember(result, key);
    return result;
  }

  /// True if the lungs' stage left this file; others may stand there from an earlier run.
  bool lungsLeft(const std::string& file) const {
    return state_.at("stages").at(name(Stage::Lungs)).at("files").contains(file);
  }

  std::vector<std::filesystem::path> surfaceFiles() const {
    std::vector<std::filesystem::path> files;
    for (const Lobe lung : {Lobe::RightLung, Lobe::LeftLung}) {
      const std::string file = std::string(shortName(lung)) + ".vtp";
      if (lungsLeft(file)) files.push_back(in(file));
    }
    return files;
  }

  const Recipe& recipe_;
  const RunOptions& options_;
  Json before_;
  Json state_;
  LungModel model_;
  std::string openKey_;
  std::string lungsKey_;
  std::string airwaysKey_;
  bool lungsKept_ = false;  ///< hashing their files twice would take as long as reading a CT
  bool upstreamChanged_ = false;
};

}  // namespace

std::vector<StageResult> runRecipe(const Recipe& recipe, const RunOptions& options,
                                   const Progress& progress) {
  if (recipe.ct.empty()) throw InvalidInput("the recipe names no CT under \"open\": \"ct\"");
  if (!std::filesystem::exists(recipe.ct)) {
    throw InputMissing("there is no '" + recipe.ct.string() + "'; check the path of the CT");
  }
  return Runner(recipe, options).run(progress);
}

}  // namespace pneuma
