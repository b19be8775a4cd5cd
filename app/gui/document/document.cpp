#include "document/document.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/seconds.h"
#include "document/held_bytes.h"
#include "document/text.h"
#include "io/atomic_file.h"
#include "io/tree_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/organs.h"
#include "pipeline/report.h"
#include "pipeline/sample_chest.h"

namespace pneuma {

namespace {

constexpr std::size_t UndoSteps = MostSavedSteps;  ///< what is there is saved, too

/// False if they are of two cases, as far as anybody can tell.
bool sharesAnything(const LungModel& a, const LungModel& b) {
  const auto same = [](const auto& x, const auto& y) { return x && x == y; };
  return same(a.ct, b.ct) || same(a.ctSource, b.ctSource) || same(a.surfaces, b.surfaces) ||
         same(a.wholeLungs, b.surfaces) || same(a.surfaces, b.wholeLungs) ||
         same(a.wholeLungs, b.wholeLungs) || same(a.labels, b.labels) ||
         same(a.central, b.central) || same(a.opened, b.opened) || same(a.regions, b.regions);
}

/// A moment to go back to needs no labels that its corrections make again.
Snapshot withoutMadeLabels(Snapshot snapshot) {
  if (snapshot.model.corrections && snapshot.model.ct) snapshot.model.labels = nullptr;
  return snapshot;
}

}  // namespace

Document::Document(QObject* parent) : QObject(parent) {
  for (const GrowthMethod& method : growthMethods()) optionsOf_.push_back(method.defaults);
  connect(&jobs_, &JobQueue::failed, this, &Document::fail);
  connect(&jobs_, &JobQueue::cancelled, this, [this](const QString& title, JobKind kind) {
    emit said(kind == JobKind::FollowingLungs
                  ? tr("Stopped: surfaces and volumes are those from before the correction")
                  : tr("%1: stopped, nothing was changed").arg(title));
  });
  connect(this, &Document::changed, this, &Document::dropComparison);
  // Whether something can be undone depends on the queue being idle.
  connect(&jobs_, &JobQueue::busyChanged, this, &Document::changed);
}

void Document::setGrowthOptions(const GrowthOptions& options) {
  if (options == growthOptions()) return;
  method_ = options.index();
  optionsOf_[method_] = options;
  emit growthOptionsChanged();
}

void Document::setGrowthMethod(std::size_t method) { setGrowthOptions(optionsOf_[method]); }

bool Document::growthOutOfDate() const {
  if (!snapshot_.model.growth) return false;
  return !(snapshot_.model.growth->options == growthOptions()) ||
         snapshot_.grownIn != snapshot_.model.surfaces;
}

bool Document::canGrow() const {
  return (snapshot_.model.surfaces && !snapshot_.model.surfaces->empty()) ||
         snapshot_.model.regions != nullptr;
}

void Document::open(std::vector<std::filesystem::path> paths) {
  touched_ = paths;
  stopDrawing();
  if (paths.size() == 1 && isProjectFileName(paths.front())) {
    openProject(paths.front(), Opened::AsSaved);
    return;
  }
  jobs_.push(tr("Opening"),
             [this, paths = std::move(paths), open = snapshot_](const Progress& progress) {
               CtReading reading;
               if (const std::filesystem::path* place = dicomPlace(paths)) {
                 SeriesList list = seriesList(
                     paths, listDicomSeries(*place, progress.part(0.0, 0.2, "reading headers")));
                 if (list.toBeChosen()) {
                   return JobQueue::Continuation(
                       [this, list = std::move(list)] { emit seriesToChoose(list); });
                 }
                 reading.series.listed = list.series;
               }
               return readFiles(paths, reading, open, progress.part(0.2, 1.0, "reading"));
             });
}

void Document::openSample() {
  jobs_.push(tr("Making the sample chest"), [this](const Progress& progress) {
    SampleChest chest = sampleChest(2.0, progress.part(0.0, 0.95, "synthetic lobes"));
    LungModel model;
    model.surfaces = std::make_shared<const std::vector<LobeSurface>>(std::move(chest.lobes));
    model.central = std::make_shared<const AirwayTree>(std::move(chest.central));
    Snapshot next = snapshotOf(std::move(model), tr("Sample chest (synthetic)"));
    return JobQueue::Continuation([this, next = std::move(next)] {
      emit said(tr("Opened the sample chest: %1").arg(whatWasRead(next.model)));
      become(next, tr("open the sample chest"), StepKind::Opening);
    });
  });
}

void Document::openOrgan(std::string_view name) {
  const QString title = organTitle(name);
  jobs_.push(
      tr("Making the organ"), [this, title, organ = std::string(name)](const Progress& progress) {
        Snapshot next = snapshotOf(pneuma::openOrgan(organ), tr("%1 (built in)").arg(title));
        progress.report(1.0);
        return JobQueue::Continuation([this, title, next = std::move(next)] {
          emit said(tr("Opened the built-in organ %1: %2").arg(title, whatWasRead(next.model)));
          become(next, tr("open the organ %1").arg(title), StepKind::Opening);
        });
      });
}

void Document::setLungOptions(const LungOptions& options) {
  if (options == lungOptions_) return;
  lungOptions_ = options;
  emit lungOptionsChanged();
}

bool Document::lungsOutOfDate() const {
  return snapshot_.model.lungs && !(snapshot_.lungOptions == lungOptions_);
}

void Document::findLungs(StepKind kind) {
  jobs_.push(JobKind::FindingLungs, tr("Finding lungs"),
             [this, kind, model = snapshot_.model, name = snapshot_.name,
              options = lungOptions_](const Progress& progress) {
               const auto start = std::chrono::steady_clock::now();
               const LungModel found =
                   withLungs(model, options, progress.part(0.0, 0.7, "looking for air"));
               Snapshot next = snapshotOf(
                   withSurfaces(found, {}, progress.part(0.7, 0.95, "drawing surfaces")), name);
               next.lungOptions = options;
               return JobQueue::Continuation(
                   [this, kind, next = std::move(next), seconds = secondsSince(start)] {
                     emit said(tr("Found the lungs in %1: right %2, left %3")
                                   .arg(withUnit(seconds, 1, "s"),
                                        withUnit(next.model.lungs->right.volumeMl, 0, "mL"),
                                        withUnit(next.model.lungs->left.volumeMl, 0, "mL")));
                     become(next, tr("find lungs"), kind);
                   });
             });
}

void Document::grow() {
  if (waitsForLungs([this] { grow(); })) return;
  jobs_.push(JobKind::Growing, tr("Growing airways"),
             [this, before = snapshot_, options = growthOptions()](const Progress& progress) {
               Snapshot next = nextSnapshot(before, pneuma::grow(before.model, options, progress));
               return JobQueue::Continuation([this, next = std::move(next)] {
                 const Growth& growth = *next.model.growth;
                 emit said(tr("Grown in %1: %2, %3")
                               .arg(withUnit(growth.domainSeconds + growth.growSeconds, 1, "s"),
                                    counted(growth.result.tree.size(), "branch", "branches"),
                                    counted(next.figures->terminals, "terminal", "terminals")));
                 become(next, tr("grow airways"));
               });
             });
}

void Document::saveTree(const std::filesystem::path& path) {
  const auto shown = tree();
  if (!shown) {
    emit failed(tr("Save tree"), tr("There is no tree to save yet: open one or grow one first."));
    return;
  }
  touched_ = {path};
  jobs_.push(tr("Saving the tree"), [this, path, shown, model = snapshot_.model](const Progress&) {
    writeTree(path, *shown, treeMetadata(model));
    return JobQueue::Continuation([this, path, shown] {
      saved_ = shown;
      emit treeWasSaved();
      emit said(
          tr("Saved %1: %2").arg(fileNameOf(path), counted(shown->size(), "branch", "branches")));
    });
  });
}

void Document::saveFile(const std::filesystem::path& path, std::string content) {
  touched_ = {path};
  jobs_.push(tr("Saving"), [this, path, content = std::move(content)](const Progress&) {
    writeFile(path, content);
    return JobQueue::Continuation(
        [this, path] { emit said(tr("Saved %1").arg(fileNameOf(path))); });
  });
}

void Document::fail(const QString& title, const QString& sentence) {
  emit failed(title, withCommands(withoutFolders(sentence, touched_)));
}

void Document::become(Snapshot next, const QString& stepName, StepKind kind) {
  undo_.reserve(undo_.size() + 1);  // where memory ends, before anything has changed
  const bool otherCase = !sharesAnything(snapshot_.model, next.model);
  const bool nothingNew = !modified() && kind == StepKind::Opening;
  next.revision = ++lastRevision_;
  if (nothingNew && (otherCase || projectPath_.empty())) savedRevision_ = next.revision;
  if (otherCase) {
    // Saving must not put one person's lungs in place of another's.
    projectPath_.clear();
    unknown_ = {};
    ctStorage_ = CtStorage::Linked;
  }
  undo_.push_back({stepName, withoutMadeLabels(std::move(snapshot_))});
  redo_.clear();
  snapshot_ = std::move(next);
  forgetOldSteps();
  followRegions();
  emit changed();
}

void Document::forgetOldSteps() {
  std::vector<const Snapshot*> steps;
  for (auto step = undo_.rbegin(); step != undo_.rend(); ++step) steps.push_back(&step->snapshot);
  const std::size_t kept = std::min(UndoSteps, keptWithin(UndoBytes, snapshot_, steps));
  undo_.erase(undo_.begin(), undo_.end() - static_cast<std::ptrdiff_t>(kept));
}

void Document::undo() {
  if (canUndo()) showStep(undo_, redo_, tr("Undone: %1"));
}

void Document::redo() {
  if (canRedo()) showStep(redo_, undo_, tr("Redone: %1"));
}

void Document::showStep(std::vector<Step>& from, std::vector<Step>& to, const QString& sentence) {
  stopFollowing();
  Step step = std::move(from.back());
  from.pop_back();
  to.push_back({step.name, withoutMadeLabels(std::exchange(snapshot_, std::move(step.snapshot)))});
  restoreLabels();
  emit said(sentence.arg(step.name));
  followRegions();
  emit changed();
  followLungs();
  if (!snapshot_.model.lobes) follow();
}

}  // namespace pneuma
