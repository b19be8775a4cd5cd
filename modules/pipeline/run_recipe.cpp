#include "pipeline/run_recipe.h"

#include <array>
#include <chrono>
#include <utility>

#include "core/error.h"
#include "core/seconds.h"
#include "io/atomic_file.h"
#include "io/input_files.h"
#include "io/staged_folder.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/ct_source.h"
#include "pipeline/detail/run_folder.h"
#include "pipeline/detail/run_lobes.h"
#include "pipeline/lobe_files.h"
#include "pipeline/lung_edits_file.h"
#include "pipeline/measure_report.h"
#include "pipeline/report.h"
#include "pipeline/segment_report.h"
#include "pipeline/stage_needs.h"
#include "pipeline/tree_measurement.h"
#include "pipeline/whole_lungs.h"

namespace pneuma {
namespace {

class Runner {
 public:
  Runner(const Recipe& recipe, const RunOptions& options)
      : recipe_(recipe), options_(options), folder_(options.folder) {}

  std::vector<StageResult> run(const Progress& progress) {
    head_ = readCtHead(recipe_.ct, recipe_.series, progress.part(0.0, 0.05, "reading headers"));
    inputs_ = ctInputFiles(recipe_.ct, head_.choice);
    if (!recipe_.lungEdits.empty()) edits_ = readLungEdits(recipe_.lungEdits);
    if (splits()) lobes_ = lobeInputs(recipe_.lobes);
    if (!options_.dryRun) requireOutputs();
    std::vector<StageResult> results;
    results.push_back(open(progress.part(0.05, 0.2, "reading the CT")));
    results.push_back(lungs(progress.part(0.2, 0.5, "finding the lungs")));
    results.push_back(lobes(progress.part(0.5, 0.65, "splitting the lungs")));
    results.push_back(airways(progress.part(0.65, 0.95, "growing")));
    results.push_back(exportTree(progress.part(0.95, 1.0, "exporting")));
    progress.report(1.0);
    return results;
  }

 private:
  bool asked(Stage stage) const { return stage <= options_.upTo; }

  bool splits() const { return recipe_.split && asked(Stage::Lobes); }

  /// The files that the stages which are asked for may write.
  std::vector<std::string> outputs() const {
    std::vector<std::string> files;
    if (asked(Stage::Lungs)) {
      files = {run_files::Labels, run_files::Central, run_files::Lungs,
               surfaceFile(Lobe::RightLung), surfaceFile(Lobe::LeftLung)};
    }
    if (splits()) {
      const std::vector<std::string> lobes = runLobeFiles(lobes_);
      files.insert(files.end(), lobes.begin(), lobes.end());
    }
    if (recipe_.grow && asked(Stage::Airways)) {
      files.insert(files.end(), {run_files::Tree, run_files::Growth});
    }
    if (recipe_.grow && asked(Stage::Export)) {
      for (const std::string& format : recipe_.formats) files.push_back("tree." + format);
    }
    return files;
  }

  /// Before any work. @throws OutputFailed if a file would be lost, the CT's above all
  void requireOutputs() {
    const std::vector<std::string> files = outputs();
    for (const std::string& file : files) {
      for (const std::filesystem::path& input : inputs_) {
        std::error_code ignored;
        if (!std::filesystem::equivalent(folder_ / file, input, ignored)) continue;
        throw OutputFailed("'" + (folder_ / file).string() +
                           "' is the CT itself and would be overwritten; choose another folder");
      }
    }
    if (options_.existing == Existing::Refuse) folder_.requireOwn(files);
  }

  /// Says what a stage that is to be done takes. Before the first one starts: do it and those after
  /// it fit? @throws Error (OutOfMemory)
  void requireMemory(StageResult& result) {
    struct Need {
      Stage stage;
      const char* name;
      const char* what;
    };

    static constexpr std::array<Need, 4> Needs = {{{Stage::Open, "import", "reading the CT"},
                                                   {Stage::Lungs, "segment", "finding the lungs"},
                                                   {Stage::Lobes, "lobes", "splitting the lungs"},
                                                   {Stage::Airways, "grow", "growing"}}};
    const double sideMm = recipe_.corrections.resampleMm;
    for (const Need& need : Needs) {
      if (need.stage == result.stage) {
        result.memoryBytes = stageNeed(need.name, head_.geometry, sideMm).bytes;
      }
      const bool done = need.stage >= result.stage && asked(need.stage) &&
                        (need.stage != Stage::Lobes || splits()) &&
                        (need.stage != Stage::Airways || recipe_.grow);
      if (done && !options_.dryRun && !memoryChecked_) {
        requireStageFits(need.name, need.what, head_.geometry, sideMm);
      }
    }
    memoryChecked_ = true;
  }

  bool isKept(Stage stage, const std::string& key) {
    return !(options_.anew && stage >= options_.from) && folder_.holds(stage, key);
  }

  StageResult open(const Progress& progress) {
    StageResult result{Stage::Open, StageState::NotAsked, 0.0, {}, {}};
    const auto start = std::chrono::steady_clock::now();
    const std::string content = contentHash(inputs_, progress.part(0.0, 0.3, "reading the CT"));
    openKey_ = sha256(content + toJson(recipe_.corrections).dump() + recipe_.series.wanted +
                      versionText() + commitText());
    lungsKey_ = sha256(openKey_ + toJson(recipe_.lungs).dump() + toJson(recipe_.surfaces).dump());
    if (!recipe_.lungEdits.empty()) lungsKey_ = sha256(lungsKey_ + lungEditsText(edits_));
    lungsKept_ = asked(Stage::Lungs) && isKept(Stage::Lungs, lungsKey_);
    result.state = lungsKept_        ? StageState::Kept
                   : options_.dryRun ? StageState::Planned
                                     : StageState::Done;
    if (lungsKept_) return result;
    requireMemory(result);
    if (options_.dryRun) return result;
    CtFile file = readCt(recipe_.ct, recipe_.corrections, progress.part(0.3, 1.0, "reading the CT"),
                         head_.choice);
    if (splits() && recipe_.lobes.snap) requireThinSlices(file.image);
    requireWithin(edits_, file.image.geometry, recipe_.lungEdits);
    result.warnings = file.warnings;
    model_ =
        modelOf(std::move(file), {recipe_.ct, recipe_.corrections, recipe_.series.wanted, 0, {}});
    model_.inputs = {{recipe_.ct.string(), content}};
    result.seconds = secondsSince(start);
    return result;
  }

  StageResult lungs(const Progress& progress) {
    if (!asked(Stage::Lungs)) return {Stage::Lungs, StageState::NotAsked, 0.0, {}, {}};
    if (lungsKept_) return folder_.keep(Stage::Lungs);
    upstreamChanged_ = true;
    StageResult result{Stage::Lungs, StageState::Planned, 0.0, {}, {}};
    requireMemory(result);
    if (options_.dryRun) return result;
    const auto start = std::chrono::steady_clock::now();
    makeFolder(options_.folder);
    const std::size_t before = model_.warnings.size();
    model_ = withLungs(model_, recipe_.lungs, progress.part(0.0, 0.7, "finding the lungs"));
    model_ = withLungEdits(model_, edits_, recipe_.lungEdits, recipe_.lungs.thresholdHu,
                           progress.part(0.7, 0.8, "correcting the lungs"));
    model_ = withSurfaces(model_, recipe_.surfaces, progress.part(0.8, 0.9, "drawing surfaces"));
    result.warnings.assign(model_.warnings.begin() + static_cast<std::ptrdiff_t>(before),
                           model_.warnings.end());
    StagedFolder staged(options_.folder);
    writeVolume(staged.path() / run_files::Labels, *model_.labels);
    result.files.emplace_back(run_files::Labels);
    for (const LobeSurface& surface : *model_.surfaces) {
      writeSurface(staged.path() / surfaceFile(surface.lobe), *surface.mesh);
      result.files.push_back(surfaceFile(surface.lobe));
      progress.report(0.95);
    }
    if (model_.central) {
      writeTree(staged.path() / run_files::Central, *model_.central,
                {{"method", "measured in a CT"}, {"version", versionText()}});
      result.files.emplace_back(run_files::Central);
    }
    result.seconds = secondsSince(start);
    const Json report = segmentReport(model_, recipe_.lungs, 0.0, result.seconds);
    writeFile(staged.path() / run_files::Lungs, textOf(report));
    result.files.emplace_back(run_files::Lungs);
    result.state = StageState::Done;
    folder_.place(staged, result, lungsKey_);
    return result;
  }

  StageResult lobes(const Progress& progress) {
    if (!splits()) return {Stage::Lobes, StageState::NotAsked, 0.0, {}, {}};
    lobesKey_ = sha256(lungsKey_ + contentKey(recipe_.lobes));
    if (!upstreamChanged_ && isKept(Stage::Lobes, lobesKey_)) return folder_.keep(Stage::Lobes);
    upstreamChanged_ = true;
    StageResult result{Stage::Lobes, StageState::Planned, 0.0, {}, {}};
    requireMemory(result);
    if (options_.dryRun) return result;
    const auto start = std::chrono::steady_clock::now();
    LungModel model =
        untangled(openLobes(lungFiles(), progress.part(0.0, 0.2, "reading surfaces")));
    model = withLabels(model, folder_ / run_files::Labels, progress.part(0.2, 0.25, "reading"));
    if (recipe_.lobes.snap || hasThinSlices(model.labels->geometry)) {
      model.ct = model_.ct ? model_.ct
                           : std::make_shared<const CtImage>(
                                 readCt(recipe_.ct, recipe_.corrections,
                                        progress.part(0.25, 0.4, "reading the CT"), head_.choice)
                                     .image);
    }
    StagedFolder staged(options_.folder);
    result.files = writeRunLobes(options_.folder, staged.path(), model, recipe_.lobes, lobes_,
                                 result.warnings, progress.part(0.4, 1.0, "splitting the lungs"));
    result.seconds = secondsSince(start);
    result.state = StageState::Done;
    folder_.place(staged, result, lobesKey_);
    return result;
  }

  StageResult airways(const Progress& progress) {
    if (!recipe_.grow || !asked(Stage::Airways)) {
      return {Stage::Airways, StageState::NotAsked, 0.0, {}, {}};
    }
    const std::string options =
        std::visit([](const auto& chosen) { return toJson(chosen).dump(); }, recipe_.growth);
    airwaysKey_ =
        sha256(lungsKey_ + lobesKey_ + std::string(growthMethod(recipe_.growth).name) + options);
    if (!upstreamChanged_ && isKept(Stage::Airways, airwaysKey_))
      return folder_.keep(Stage::Airways);
    upstreamChanged_ = true;
    StageResult result{Stage::Airways, StageState::Planned, 0.0, {}, {}};
    requireMemory(result);
    if (options_.dryRun) return result;
    const auto start = std::chrono::steady_clock::now();
    // The lungs as their files have them, whether they were found now or before.
    LungModel model = openLobes(splits() ? lobeFiles() : lungFiles(),
                                progress.part(0.0, 0.2, "reading surfaces"));
    if (folder_.left(Stage::Lungs, run_files::Central)) {
      model = withCentral(model, folder_ / run_files::Central);
    }
    model = pneuma::grow(model, recipe_.growth, progress.part(0.2, 0.9, "growing"));
    const TreeMeasurement measured = measureTree(*treeOf(model), model, seedOf(recipe_.growth),
                                                 progress.part(0.9, 1.0, "measuring"));
    StagedFolder staged(options_.folder);
    writeTree(staged.path() / run_files::Tree, model.growth->result.tree, treeMetadata(model));
    result.files.emplace_back(run_files::Tree);
    result.seconds = secondsSince(start);
    writeFile(staged.path() / run_files::Growth,
              textOf(growthReport(model, measured.whole, measured.byLobe, 0.0, 0.0)));
    result.files.emplace_back(run_files::Growth);
    result.warnings = model.warnings;
    const std::vector<std::string>& grown = model.growth->result.warnings;
    result.warnings.insert(result.warnings.end(), grown.begin(), grown.end());
    result.state = StageState::Done;
    folder_.place(staged, result, airwaysKey_);
    return result;
  }

  StageResult exportTree(const Progress& progress) {
    if (recipe_.formats.empty() || !recipe_.grow || !asked(Stage::Export)) {
      return {Stage::Export, StageState::NotAsked, 0.0, {}, {}};
    }
    std::string key = airwaysKey_;
    for (const std::string& format : recipe_.formats) key += format;
    key = sha256(key);
    if (!upstreamChanged_ && isKept(Stage::Export, key)) return folder_.keep(Stage::Export);
    StageResult result{Stage::Export, StageState::Planned, 0.0, {}, {}};
    if (options_.dryRun) return result;
    const auto start = std::chrono::steady_clock::now();
    const TreeFile tree = readTree(folder_ / run_files::Tree);
    StagedFolder staged(options_.folder);
    for (const std::string& format : recipe_.formats) {
      writeTree(staged.path() / ("tree." + format), tree.tree, tree.metadata);
      result.files.emplace_back("tree." + format);
      progress.throwIfStopped();
    }
    result.seconds = secondsSince(start);
    result.state = StageState::Done;
    folder_.place(staged, result, key);
    return result;
  }

  static std::string surfaceFile(Lobe lung) { return std::string(shortName(lung)) + ".vtp"; }

  std::vector<std::filesystem::path> lobeFiles() const {
    std::vector<std::filesystem::path> files;
    for (const Side side : {Side::Right, Side::Left}) {
      for (const Lobe lobe : lobesOf(side)) {
        const std::string file =
            (std::filesystem::path(run_files::Lobes) / lobeFile(lobe)).generic_string();
        if (folder_.left(Stage::Lobes, file)) files.push_back(folder_ / file);
      }
    }
    return files;
  }

  std::vector<std::filesystem::path> lungFiles() const {
    std::vector<std::filesystem::path> files;
    for (const Lobe lung : {Lobe::RightLung, Lobe::LeftLung}) {
      const std::string file = surfaceFile(lung);
      if (folder_.left(Stage::Lungs, file)) files.push_back(folder_ / file);
    }
    return files;
  }

  const Recipe& recipe_;
  const RunOptions& options_;
  RunFolder folder_;
  CtHead head_;
  std::vector<std::filesystem::path> inputs_;  ///< files of the CT
  LungModel model_;
  std::vector<LungEdit> edits_;  ///< of the lungs
  LobeInputs lobes_;
  std::string openKey_;
  std::string lungsKey_;
  std::string lobesKey_;  ///< empty if the lungs are not split
  std::string airwaysKey_;
  bool lungsKept_ = false;  ///< hashing their files twice would take as long as reading a CT
  bool upstreamChanged_ = false;
  bool memoryChecked_ = false;
};

}  // namespace

std::vector<StageResult> runRecipe(const Recipe& recipe, const RunOptions& options,
                                   const Progress& progress) {
  if (recipe.ct.empty()) throw InvalidInput("the recipe names no CT under \"open\": \"ct\"");
  std::error_code ignored;
  if (!std::filesystem::exists(recipe.ct, ignored)) {
    throw InputMissing("there is no '" + recipe.ct.string() + "'; check the path of the CT");
  }
  return Runner(recipe, options).run(progress);
}

}  // namespace pneuma
