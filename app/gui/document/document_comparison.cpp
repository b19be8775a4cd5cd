#include <utility>

#include "document/document.h"
#include "document/text.h"
#include "io/atomic_file.h"
#include "pipeline/compare_methods.h"

// Trees of all methods beside each other.
namespace pneuma {

void Document::compareMethods() {
  if (waitsForLungs([this] { compareMethods(); })) return;
  bool there = comparison_ != nullptr;
  for (std::size_t i = 0; there && i < optionsOf_.size(); ++i) {
    there = comparison_->growths[i]->options == optionsOf_[i];
  }
  if (there) {
    emit compared();
    return;
  }
  jobs_.push(JobKind::Comparing, tr("Comparing methods"),
             [this, model = snapshot_.model, options = optionsOf_](const Progress& progress) {
               auto found = std::make_shared<MethodComparison>(
                   pneuma::compareMethods(model, options, progress));
               return JobQueue::Continuation([this, model, found = std::move(found)] {
                 comparison_ = found;
                 comparedIn_ = model;
                 double seconds = 0.0;
                 for (const auto& growth : found->growths) seconds += growth->growSeconds;
                 emit said(tr("Grown by %1 in %2: nothing was changed until you keep a tree")
                               .arg(counted(found->growths.size(), "method", "methods"),
                                    withUnit(seconds, 1, "s")));
                 emit compared();
               });
             });
}

void Document::keepCompared(std::size_t method) {
  if (!comparison_ || jobs_.busy()) return;
  const auto comparison = comparison_;
  const GrowthOptions options = comparison->growths.at(method)->options;
  Snapshot next = nextSnapshot(snapshot_, withGrowthOf(snapshot_.model, *comparison, method));
  const QString title = qtText(growthMethod(options).title);
  // The case's central airways may be the template from now on; the trees are still of them.
  comparedIn_ = next.model;
  setGrowthOptions(options);
  emit said(tr("Kept the tree of %1: %2")
                .arg(title, counted(comparison->growths[method]->result.tree.size(), "branch",
                                    "branches")));
  become(std::move(next), tr("keep the tree of %1").arg(title));
}

void Document::saveComparison(const std::filesystem::path& path) {
  if (!comparison_) return;
  touched_ = {path};
  jobs_.push(tr("Saving the table"), [this, path, shown = comparison_](const Progress&) {
    writeFile(path, compareCsv(shown->measured));
    return JobQueue::Continuation(
        [this, path] { emit said(tr("Saved %1").arg(fileNameOf(path))); });
  });
}

void Document::dropComparison() {
  if (!comparison_) return;
  const LungModel& now = snapshot_.model;
  const bool same = now.surfaces == comparedIn_.surfaces && now.central == comparedIn_.central &&
                    (now.surfaces || now.regions == comparedIn_.regions);
  if (same) return;
  comparison_ = nullptr;
  comparedIn_ = {};
}

}  // namespace pneuma
