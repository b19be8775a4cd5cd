#include <algorithm>
#include <utility>

#include "core/error.h"
#include "document/breath.h"
#include "document/document.h"
#include "document/held_bytes.h"
#include "document/project_snapshot.h"
#include "document/text.h"
#include "pipeline/ct_source.h"

// Saving everything, and opening it again.
namespace pneuma {

bool Document::workUnsaved() const {
  if (!modified()) return false;
  const LungModel& model = snapshot_.model;
  const bool onlyGrown = !model.lobes && !model.lungs && !model.corrections && !snapshot_.breath &&
                         snapshot_.lobeEdits == LobeEdits{};
  return !(onlyGrown && treeSaved());
}

Project Document::projectNow(std::size_t historyBytes) const {
  Project project;
  project.state = stateOf(snapshot_);
  std::vector<const Snapshot*> nearest;
  for (auto step = undo_.rbegin(); step != undo_.rend(); ++step) nearest.push_back(&step->snapshot);
  for (auto step = redo_.rbegin(); step != redo_.rend(); ++step) nearest.push_back(&step->snapshot);
  const auto kept = static_cast<std::ptrdiff_t>(keptWithin(historyBytes, snapshot_, nearest));
  const auto undos = std::min(kept, static_cast<std::ptrdiff_t>(undo_.size()));
  for (auto step = undo_.end() - undos; step != undo_.end(); ++step) {
    project.undo.push_back({step->name.toStdString(), stateOf(step->snapshot)});
  }
  for (auto step = redo_.rbegin(); step != redo_.rbegin() + (kept - undos); ++step) {
    project.redo.push_back({step->name.toStdString(), stateOf(step->snapshot)});
  }
  project.next = {optionsOf_, method_, lungOptions_, breatheOptions_};
  project.unknown = unknown_;
  return project;
}

void Document::replaceSource(const std::shared_ptr<const CtSource>& before,
                             const std::shared_ptr<const CtSource>& after,
                             const std::shared_ptr<const CtImage>& found) {
  const auto replace = [&](LungModel& model) {
    if (model.ctSource != before) return;
    model.ctSource = after;
    if (found) model.ct = found;
  };
  replace(snapshot_.model);
  for (Step& step : undo_) replace(step.snapshot.model);
  for (Step& step : redo_) replace(step.snapshot.model);
}

void Document::saveProject(const std::filesystem::path& path, CtStorage ct, Json view,
                           std::string thumbnail) {
  touched_ = {path};
  Project project = projectNow();
  project.ctStorage = ct;
  project.view = std::move(view);
  project.thumbnail = std::move(thumbnail);
  jobs_.push(tr("Saving the project"),
             [this, path, project = std::move(project), revision = snapshot_.revision,
              shown = tree()](const Progress& progress) mutable {
               const auto before = project.state.model.ctSource;
               auto source = before;
               if (before && project.state.model.ct) {
                 source = std::make_shared<const CtSource>(
                     hashed(*before, progress.part(0.0, 0.4, "hashing the CT")));
                 replaceCtSource(project, before, source);
               }
               writeProject(path, project, progress.part(0.4, 1.0, "saving"));
               return JobQueue::Continuation(
                   [this, path, before, source, revision, shown, ct = project.ctStorage] {
                     replaceSource(before, source);
                     projectPath_ = path;
                     ctStorage_ = ct;
                     savedRevision_ = revision;
                     emit said(tr("Saved %1").arg(fileNameOf(path)));
                     emit changed();
                     emit projectWasSaved();
                   });
             });
}

void Document::recover(const std::filesystem::path& file) {
  touched_ = {file};
  openProject(file, Opened::Recovered);
}

void Document::openProject(const std::filesystem::path& path, Opened how) {
  jobs_.push(tr("Opening the project"), [this, path, how](const Progress& progress) {
    Project project = readProject(path, progress.part(0.0, 0.6, "reading"));
    std::vector<Step> undo;
    Snapshot last;
    for (const ProjectStep& step : project.undo) {
      progress.throwIfStopped();
      last = snapshotOf(step.state, last);
      undo.push_back({qtText(step.name), last});
    }
    Snapshot now = snapshotOf(project.state, last);
    if (project.state.breath) {
      try {
        now.breath = breathOf(project.state, progress.part(0.7, 1.0, "moving lungs"));
      } catch (const Error& problem) {
        project.notes.push_back(std::string("The lungs do not breathe any more: ") +
                                problem.what());
      }
    }
    std::vector<Step> redo;
    last = now;
    for (const ProjectStep& step : project.redo) {
      progress.throwIfStopped();
      last = snapshotOf(step.state, last);
      redo.insert(redo.begin(), {qtText(step.name), last});
    }
    project.undo.clear();
    project.redo.clear();
    return JobQueue::Continuation([this, path, how, project = std::move(project),
                                   undo = std::move(undo), redo = std::move(redo),
                                   now = std::move(now)]() mutable {
      undo_ = std::move(undo);
      redo_ = std::move(redo);
      for (Step& step : undo_) step.snapshot.revision = ++lastRevision_;
      for (Step& step : redo_) step.snapshot.revision = ++lastRevision_;
      snapshot_ = std::move(now);
      showProject(std::move(project), path, how);
    });
  });
}

void Document::showProject(Project project, const std::filesystem::path& path, Opened how) {
  snapshot_.revision = ++lastRevision_;
  savedRevision_ = how == Opened::AsSaved ? lastRevision_ : 0;
  saved_ = nullptr;
  projectPath_ = path;
  if (how == Opened::Recovered) {
    projectPath_ = project.view.value("project", std::string());
    project.view.erase("project");
  }
  ctStorage_ = project.ctStorage;
  unknown_ = std::move(project.unknown);
  openedView_ = std::move(project.view);
  for (const GrowthOptions& options : project.next.growth) optionsOf_[options.index()] = options;
  if (project.next.method < optionsOf_.size()) method_ = project.next.method;
  lungOptions_ = project.next.lungs;
  breatheOptions_ = project.next.breathe;
  breathFile_.reset();
  constantsFile_.reset();
  emit growthOptionsChanged();
  emit lungOptionsChanged();
  emit breatheOptionsChanged();
  emit said(how == Opened::AsSaved ? tr("Opened %1").arg(fileNameOf(path))
                                   : tr("Recovered; save it to keep it"));
  emit changed();
  emit projectWasOpened();
  followLungs();
  if (project.notes.empty()) return;
  QStringList sentences;
  for (const std::string& note : project.notes) sentences << qtText(note);
  const QString title = tr("Opening the project");
  const QString all = sentences.join(QLatin1Char(' '));
  if (ctMissing()) {
    emit ctMissed(title, all);
  } else {
    emit failed(title, all);
  }
}

}  // namespace pneuma
