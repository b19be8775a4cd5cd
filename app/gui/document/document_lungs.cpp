#include <algorithm>
#include <utility>

#include "core/error.h"
#include "document/document.h"
#include "document/text.h"
#include "io/atomic_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/lung_edits_file.h"

// Lungs that are corrected by hand, and what follows.
namespace pneuma {

namespace {

bool hasLungs(const LabelImage& labels) {
  return std::ranges::any_of(labels.voxels, [](std::uint8_t label) {
    return label == static_cast<std::uint8_t>(Lobe::RightLung) ||
           label == static_cast<std::uint8_t>(Lobe::LeftLung);
  });
}

}  // namespace

QString Document::correctionObstacle() const {
  if (!idle()) return tr("A job is running");
  const LungModel& model = snapshot_.model;
  if (!model.ct) return tr("Open a CT first");
  if (!model.labels) return tr("Find the lungs first");
  if (!sameVoxels(model.ct->geometry, model.labels->geometry)) {
    return tr("The labels have other voxels than the CT: find the lungs first");
  }
  return {};
}

void Document::correctLungs(LungEdit edit, std::shared_ptr<const LabelImage> labels,
                            const QString& what) {
  if (const QString obstacle = correctionObstacle(); !obstacle.isEmpty()) {
    emit said(obstacle);
    emit changed();  // whoever showed the edit shows what is there again
    return;
  }
  becomeCorrected({std::move(edit)}, std::move(labels), what);
}

void Document::becomeCorrected(std::vector<LungEdit> edits,
                               std::shared_ptr<const LabelImage> labels, const QString& what) {
  stopFollowing();
  Snapshot next =
      nextSnapshot(snapshot_, withEdits(snapshot_.model, std::move(edits), std::move(labels)));
  next.splitEdits = {};
  next.traces = nullptr;
  next.reviews.clear();
  next.grownIn = nullptr;
  next.breath = nullptr;
  become(std::move(next), what);
  followLungs();
}

void Document::correctByJob(const QString& title, std::function<std::vector<LungEdit>()> edits,
                            const QString& what) {
  if (const QString obstacle = correctionObstacle(); !obstacle.isEmpty()) {
    emit said(obstacle);
    return;
  }
  jobs_.push(JobKind::CorrectingLungs, title,
             [this, edits = std::move(edits), what, ct = snapshot_.model.ct,
              labels = snapshot_.model.labels](const Progress& progress) {
               std::vector<LungEdit> read = edits();
               auto edited =
                   std::make_shared<const LabelImage>(editedLabels(*ct, *labels, read, progress));
               return JobQueue::Continuation(
                   [this, read = std::move(read), edited = std::move(edited), labels, what] {
                     // Undone or replaced in the meantime: these edits were of something else.
                     if (snapshot_.model.labels != labels || read.empty()) return;
                     becomeCorrected(read, edited, what);
                   });
             });
}

void Document::growSeed(LungEdit seed, const QString& what) {
  correctByJob(
      tr("Growing from the seed"), [seed = std::move(seed)] { return std::vector{seed}; }, what);
}

void Document::openLungEdits(const std::filesystem::path& path) {
  touched_ = {path};
  correctByJob(
      tr("Correcting the lungs"), [path] { return readLungEdits(path); },
      tr("open lung corrections"));
}

void Document::saveLungEdits(const std::filesystem::path& path) {
  const auto& corrections = snapshot_.model.corrections;
  if (!corrections) {
    emit failed(tr("Save lung corrections"), tr("The lungs were not corrected by hand yet."));
    return;
  }
  touched_ = {path};
  jobs_.push(tr("Saving lung corrections"), [this, path, corrections](const Progress&) {
    writeFile(path, lungEditsText(corrections->edits), Existing::Replace);
    return JobQueue::Continuation([this, path, count = corrections->edits.size()] {
      emit said(tr("Saved %1: %2").arg(fileNameOf(path), counted(count, "edit", "edits")));
    });
  });
}

void Document::stopFollowing() {
  jobs_.supersede({JobKind::FollowingLungs, JobKind::TracingFissures});
}

bool Document::waitsForLungs(std::function<void()> then) {
  if (!followingLungs()) return false;
  jobs_.push(tr("Waiting for the lungs"), [this, then = std::move(then)](const Progress&) {
    return JobQueue::Continuation([this, then] {
      if (snapshot_.lungsFollow()) then();
    });
  });
  return true;
}

void Document::followLungs() {
  const LungModel& now = snapshot_.model;
  if (snapshot_.lungsFollow() || !now.ct || !now.labels || followingLungs()) return;
  jobs_.push(JobKind::FollowingLungs, tr("Drawing the corrected lungs"),
             [this, before = snapshot_](const Progress& progress) {
               LungModel model = measuredAgain(before.model, before.lungOptions.thresholdHu,
                                               progress.part(0.0, 0.3, "measuring"));
               if (hasLungs(*model.labels)) {
                 model = withSurfaces(model, {}, progress.part(0.3, 0.95, "drawing surfaces"));
               } else {
                 model.surfaces = nullptr;
               }
               Snapshot next = nextSnapshot(before, std::move(model));
               // Places in the patient stay where they are.
               next.lobeEdits = before.lobeEdits;
               next.regions = before.regions;
               next.drawn = next.model.corrections;
               return JobQueue::Continuation([this, next = std::move(next)] {
                 snapshot_ = next;
                 snapshot_.revision = ++lastRevision_;
                 if (const auto& lungs = snapshot_.model.lungs) {
                   emit said(tr("Corrected: right lung %1, left lung %2")
                                 .arg(withUnit(lungs->right.volumeMl, 0, "mL"),
                                      withUnit(lungs->left.volumeMl, 0, "mL")));
                 }
                 emit changed();
               });
             });
}

void Document::restoreLabels() {
  LungModel& model = snapshot_.model;
  if (!model.corrections || model.labels || !model.ct) return;
  try {
    model.labels = correctedLabels(model);
  } catch (const Error& error) {
    emit failed(tr("Undo"), QString::fromStdString(error.what()));
  }
}

}  // namespace pneuma
