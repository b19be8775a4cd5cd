#include <chrono>
#include <utility>

#include "core/seconds.h"
#include "document/document.h"
#include "document/text.h"
#include "pipeline/lobes_model.h"

// What the document knows of lobes and fissures.
namespace pneuma {

bool Document::lobesOutOfDate() const {
  return snapshot_.model.lobes && !(snapshot_.splitEdits == snapshot_.lobeEdits);
}

void Document::setLobeEdits(const LobeEdits& edits, const QString& what) {
  if (edits == snapshot_.lobeEdits) return;
  if (jobs_.busy() && !splitting_) {
    emit said(tr("A job is running: cancel it or wait before editing fissures."));
    return;
  }
  // Lobes of the fissures before are of no use any more.
  if (splitting_) jobs_.cancel();
  Snapshot next = snapshot_;
  next.lobeEdits = edits;
  become(std::move(next), what);
  if (snapshot_.model.lobes) split({});
}

void Document::splitLobes() { split(tr("split lungs into lobes")); }

void Document::split(const QString& stepName) {
  splitting_ = true;
  jobs_.push(tr("Splitting lungs"), [this, stepName, before = snapshot_](const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    Snapshot next = nextSnapshot(before, withLobes(before.model, inputsOf(before.lobeEdits),
                                                   before.lobeEdits.options, progress));
    next.splitEdits = before.lobeEdits;
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
      emit changed();
    });
  });
}

}  // namespace pneuma
