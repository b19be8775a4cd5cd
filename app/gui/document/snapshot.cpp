#include "document/snapshot.h"

#include <utility>

#include "core/error.h"
#include "document/breath.h"
#include "document/text.h"
#include "pipeline/lobe_labels.h"
#include "pipeline/lobes_model.h"

namespace pneuma {

namespace {

/// Lungs that nothing can be told of are left out: splitting them says why.
std::vector<std::shared_ptr<const LungShape>> lungsOf(const LungModel& model) {
  std::vector<std::shared_ptr<const LungShape>> lungs;
  const auto surfaces = wholeLungsOf(model);
  if (!surfaces) return lungs;
  for (const LobeSurface& surface : *surfaces) {
    const bool lung = surface.lobe == Lobe::RightLung || surface.lobe == Lobe::LeftLung;
    if (!lung || !surface.health.fitToGrow()) continue;
    try {
      lungs.push_back(
          std::make_shared<const LungShape>(lungShape(surface.mesh, side(surface.lobe))));
    } catch (const InvalidInput&) {
      continue;
    }
  }
  return lungs;
}

/// In slices of a CT whose lungs were not found the surfaces tell where they are.
std::shared_ptr<const LabelImage> labelsOf(const LungModel& model) {
  const auto surfaces = wholeLungsOf(model);
  if (!model.ct || model.labels || model.corrections || !surfaces) return nullptr;
  LungModel whole;
  whole.surfaces = surfaces;
  try {
    return std::make_shared<const LabelImage>(lungLabels(whole));
  } catch (const InvalidInput&) {
    return nullptr;  // far too large: nothing is drawn
  }
}

void addFigures(Snapshot& snapshot) {
  const auto tree = treeOf(snapshot.model);
  snapshot.figures = tree ? std::make_shared<const TreeFigures>(treeFigures(*tree)) : nullptr;
}

}  // namespace

Snapshot snapshotOf(LungModel model, const QString& name) {
  Snapshot snapshot{std::move(model), nullptr, name};
  addFigures(snapshot);
  snapshot.lungs = lungsOf(snapshot.model);
  snapshot.lungLabels = labelsOf(snapshot.model);
  return snapshot;
}

Snapshot nextSnapshot(const Snapshot& before, LungModel model) {
  Snapshot next = before;
  next.model = std::move(model);
  if (!next.model.corrections) next.drawn = nullptr;
  if (treeOf(next.model) != treeOf(before.model)) addFigures(next);
  if (next.model.growth != before.model.growth) next.grownIn = next.model.surfaces;
  if (next.model.surfaces != before.model.surfaces || treeOf(next.model) != treeOf(before.model)) {
    next.breath = nullptr;
  }
  const bool sameLungs = wholeLungsOf(next.model) == wholeLungsOf(before.model);
  const bool sameCt = next.model.ct == before.model.ct && next.model.labels == before.model.labels;
  if (!sameLungs || !sameCt) next.lungLabels = labelsOf(next.model);
  if (sameLungs) return next;
  next.lungs = lungsOf(next.model);
  next.lobeEdits = next.splitEdits = {};
  next.regions.clear();
  next.traces = nullptr;
  next.reviews.clear();
  return next;
}

double lungVolumeMl(const LungModel& model) {
  double sum = 0.0;
  if (model.surfaces) {
    for (const auto& surface : *model.surfaces) sum += surface.health.volumeMl;
  }
  return sum;
}

QString whatWasRead(const LungModel& model) {
  QStringList parts;
  if (model.ct) parts << QStringLiteral("a CT of %1 voxels").arg(sizeText(model.ct->geometry));
  if (model.labels && !model.ct) parts << QStringLiteral("labels");
  if (model.surfaces) parts << counted(model.surfaces->size(), "surface", "surfaces");
  if (!model.surfaces && model.regions) {
    parts << counted(model.regions->size(), "region", "regions");
  }
  if (const auto tree = treeOf(model)) parts << counted(tree->size(), "branch", "branches");
  return parts.join(QStringLiteral(" and "));
}

std::vector<QString> warningsOf(const Snapshot& snapshot) {
  std::vector<QString> warnings;
  for (const auto& sentence : snapshot.model.warnings) warnings.push_back(qtText(sentence));
  if (snapshot.breath) {
    for (const auto& sentence : snapshot.breath->lungs.warnings)
      warnings.push_back(qtText(sentence));
  }
  if (snapshot.model.lobes) {
    for (const auto& sentence : snapshot.model.lobes->warnings)
      warnings.push_back(qtText(sentence));
  }
  if (!snapshot.model.growth) return warnings;
  for (const auto& sentence : snapshot.model.growth->result.warnings) {
    warnings.push_back(qtText(sentence));
  }
  const Outside& outside = snapshot.model.growth->outside;
  if (outside.ends > 0 || outside.segments > 0) {
    warnings.push_back(QStringLiteral("%1 and %2 of the grown airways leave their lobe; set "
                                      "containment to branches to keep them inside.")
                           .arg(counted(outside.ends, "end", "ends"),
                                counted(outside.segments, "segment", "segments")));
  }
  return warnings;
}

}  // namespace pneuma
