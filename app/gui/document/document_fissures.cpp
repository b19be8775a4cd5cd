#include <algorithm>
#include <utility>

#include "core/error.h"
#include "document/document.h"
#include "document/text.h"
#include "io/fissure_file.h"

// Files of fissures, and who looked at them.
namespace pneuma {

void Document::openFissures(const std::filesystem::path& path) {
  if (!mayEdit()) return;
  touched_ = {path};
  jobs_.push(tr("Opening fissures"), [this, path, lungs = snapshot_.lungs](const Progress&) {
    const FissureFile file = readFissureFile(path);
    for (const auto& [fissure, given] : file.fissures) {
      const bool there =
          std::ranges::any_of(lungs, [&](const auto& lung) { return lung->side == side(fissure); });
      if (there) continue;
      throw InvalidInput("the file gives a " + std::string(longName(fissure)) +
                         ", but that lung is not open");
    }
    return JobQueue::Continuation([this, path, accessory = file.accessory.size(),
                                   fissures = editsOf(file.fissures, lungs)] {
      LobeEdits edits = snapshot_.lobeEdits;
      edits.fissures = fissures;
      if (edits != snapshot_.lobeEdits) take(edits, tr("open fissures"));
      emit said(tr("Opened %1: %2")
                    .arg(fileNameOf(path), counted(fissures.size(), "fissure", "fissures")) +
                (accessory == 0 ? QString()
                                : tr("; accessory ones are for the command line, and left out")));
    });
  });
}

void Document::openFissureSurface(Fissure fissure, const std::filesystem::path& path) {
  if (!mayEdit()) return;
  touched_ = {path};
  jobs_.push(tr("Opening the surface of a fissure"), [this, fissure, path](const Progress&) {
    auto given = std::make_shared<GivenFissure>();
    given->patch = readFissurePatch(path);
    return JobQueue::Continuation([this, fissure, given = std::move(given)] {
      LobeEdits edits = snapshot_.lobeEdits;
      edits.fissures[fissure].method = FissureMethod::Surface;
      edits.fissures[fissure].read = given;
      take(edits, tr("take a surface"));
    });
  });
}

void Document::saveFissures(const std::filesystem::path& path) {
  GivenFissures given = givenOf(snapshot_.lobeEdits);
  if (given.empty()) {
    emit failed(tr("Save fissures"),
                tr("No fissure was set yet: all of them are proposed by the lungs' shape."));
    return;
  }
  // What is seen: points where they were drawn to.
  if (snapshot_.traces && snapshot_.traces->edits == snapshot_.lobeEdits) {
    for (auto& [fissure, one] : given) {
      const auto traced = snapshot_.traces->fissures.find(fissure);
      if (traced == snapshot_.traces->fissures.end()) continue;
      if (traced->second.points.size() == one.points.size()) one.points = traced->second.points;
    }
  }
  touched_ = {path};
  jobs_.push(tr("Saving fissures"), [this, path, given = std::move(given)](const Progress&) {
    writeFissures(path, given);
    return JobQueue::Continuation([this, path, count = given.size()] {
      emit said(tr("Saved %1: %2").arg(fileNameOf(path), counted(count, "fissure", "fissures")));
    });
  });
}

void Document::setReviewed(const std::vector<Fissure>& fissures, bool skipped) {
  Snapshot next = snapshot_;
  for (const Fissure fissure : fissures) {
    next.reviews[fissure] = {concerning(snapshot_.lobeEdits, fissure), skipped};
  }
  if (next.reviews == snapshot_.reviews) return;
  if (jobs_.busy()) {
    emit said(tr("A job is running: wait before saying that fissures are right."));
    return;
  }
  become(std::move(next), skipped ? tr("accept fissures") : tr("review a fissure"));
}

bool Document::reviewed(Fissure fissure) const {
  const auto found = snapshot_.reviews.find(fissure);
  return found != snapshot_.reviews.end() &&
         found->second.edits == concerning(snapshot_.lobeEdits, fissure);
}

}  // namespace pneuma
