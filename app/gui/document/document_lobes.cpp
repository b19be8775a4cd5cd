#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.h"
#include "core/seconds.h"
#include "document/document.h"
#include "document/text.h"
#include "pipeline/lobes_model.h"

// What the document knows of lobes and fissures.
namespace pneuma {

namespace {

/// The model with its whole lungs for surfaces.
LungModel wholeOf(LungModel model) {
  model.surfaces = wholeLungsOf(model);
  return model;
}

}  // namespace

bool Document::lobesOutOfDate() const {
  return snapshot_.model.lobes && !(snapshot_.splitEdits == snapshot_.lobeEdits);
}

QString Document::snapObstacle() const {
  const LungModel& model = snapshot_.model;
  if (!model.ct) return tr("Needs a CT of these lungs with slices up to 1.5 mm.");
  if (!hasThinSlices(*model.ct)) {
    return tr("The slices are %1 apart: fissures show only up to %2.")
        .arg(withUnit(model.ct->geometry.spacing.maxCoeff(), 2, "mm"),
             withUnit(ThickestSliceMm, 1, "mm"));
  }
  if (!model.labels) return tr("Find the lungs in the CT first.");
  return {};
}

bool Document::sheetsKnown() const {
  return sheets_.ct && sheets_.ct == snapshot_.model.ct &&
         sheets_.labels == snapshot_.model.labels &&
         std::ranges::all_of(snapshot_.lungs,
                             [this](const auto& lung) { return sheets_.of.contains(lung->side); });
}

std::shared_ptr<const SheetnessImage> Document::sheets(Side side) const {
  const auto found = sheets_.of.find(side);
  return sheetsKnown() && found != sheets_.of.end() ? found->second : nullptr;
}

bool Document::mayEdit() {
  if (!jobs_.busy() || lookingForFissures() || splitting() || jobs_.has(JobKind::TracingFissures))
    return true;
  emit said(tr("A job is running: cancel it or wait before editing fissures."));
  return false;
}

void Document::setLobeEdits(const LobeEdits& edits, const QString& what) {
  if (edits == snapshot_.lobeEdits || !mayEdit()) return;
  take(edits, what);
}

void Document::setSnapping(bool on) {
  if (on == snapshot_.lobeEdits.snap || lookingForFissures() || !mayEdit()) return;
  if (const QString obstacle = snapObstacle(); on && !obstacle.isEmpty()) {
    emit said(obstacle);
    return;
  }
  const auto set = [this, on] {
    LobeEdits edits = snapshot_.lobeEdits;
    edits.snap = on;
    if (on) edits.shares.clear();  // they would move the fissures off again
    take(edits, on ? tr("snap to the CT") : tr("leave the CT"));
  };
  if (!on || sheetsKnown()) {
    set();
  } else {
    look(set);
  }
}

void Document::take(const LobeEdits& edits, const QString& what) {
  // What follows the edits before is of no use any more; what shows in the CT still is.
  jobs_.supersede({JobKind::TracingFissures, JobKind::Splitting});
  Snapshot next = snapshot_;
  next.lobeEdits = edits;
  become(std::move(next), what);
  follow();
}

void Document::follow() {
  if (lookingForFissures() || !canSplit()) return;
  if (snapshot_.model.lobes) {
    split({});
  } else if (!sheetsKnown() && snapshot_.lobeEdits.snap) {
    look([this] { follow(); });
  } else if (sheetsKnown()) {
    trace();
  }
}

void Document::look(std::function<void()> then) {
  jobs_.push(
      JobKind::LookingForFissures, tr("Looking for fissures"),
      [this, then = std::move(then), lungs = snapshot_.lungs,
       model = wholeOf(snapshot_.model)](const Progress& progress) {
        CtSheets found{model.ct, model.labels, {}};
        for (const auto& lung : lungs) {
          const auto count = static_cast<double>(lungs.size());
          const auto done = static_cast<double>(found.of.size());
          found.of[lung->side] = std::make_shared<const SheetnessImage>(fissureSheets(
              model, lung->side, progress.part(done / count, (done + 1.0) / count, "looking")));
        }
        return JobQueue::Continuation([this, then, found = std::move(found)] {
          sheets_ = found;
          then();
        });
      });
}

void Document::trace() {
  if (snapshot_.traces && snapshot_.traces->edits == snapshot_.lobeEdits) return;
  jobs_.push(JobKind::TracingFissures, tr("Following fissures"),
             [this, before = snapshot_, sheets = sheets_.of](const Progress& progress) {
               TracedFissures fissures;
               for (std::size_t i = 0; i < before.lungs.size(); ++i) {
                 const auto& lung = before.lungs[i];
                 const auto share = 1.0 / static_cast<double>(before.lungs.size());
                 try {
                   const LobeInputs inputs = inputsOf(before.lobeEdits);
                   fissures.merge(tracedFissures(
                       lung, inputs, before.lobeEdits.options, sheets.at(lung->side).get(),
                       progress.part(share * static_cast<double>(i),
                                     share * static_cast<double>(i + 1), "following fissures")));
                 } catch (const InvalidInput&) {
                   continue;  // the fissure's own card says so
                 }
               }
               auto traces = fissureTraces(before.lobeEdits, std::move(fissures));
               return JobQueue::Continuation([this, traces = std::move(traces)] {
                 snapshot_.traces = traces;
                 emit changed();
               });
             });
}

void Document::splitLobes() {
  if (waitsForLungs([this] { splitLobes(); })) return;
  const QString name = tr("split lungs into lobes");
  if (canSplit() && !sheetsKnown() && snapObstacle().isEmpty()) {
    look([this, name] { split(name); });
  } else {
    split(name);
  }
}

void Document::split(const QString& stepName) {
  jobs_.push(
      JobKind::Splitting, tr("Splitting lungs"),
      [this, stepName, before = snapshot_,
       known = sheetsKnown() ? sheets_.of : decltype(sheets_.of)()](const Progress& progress) {
        const auto start = std::chrono::steady_clock::now();
        LobeInputs inputs = inputsOf(before.lobeEdits);
        inputs.sheets = known;
        Snapshot next = nextSnapshot(
            before, withLobes(before.model, inputs, before.lobeEdits.options, progress));
        next.splitEdits = before.lobeEdits;
        next.traces =
            fissureTraces(before.lobeEdits, tracedFissures(*next.model.lobes, inputs.given));
        const double seconds = secondsSince(start);
        return JobQueue::Continuation([this, stepName, seconds, next = std::move(next)] {
          emit said(tr("Split in %1: %2")
                        .arg(withUnit(seconds, 1, "s"),
                             counted(next.model.surfaces->size(), "lobe", "lobes")));
          if (!stepName.isEmpty()) {
            become(next, stepName);
            return;
          }
          snapshot_ = next;
          snapshot_.revision = ++lastRevision_;
          emit changed();
        });
      });
}

}  // namespace pneuma
