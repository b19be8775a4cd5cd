#include "document/snapshot.h"

#include <utility>

#include "document/text.h"

namespace pneuma {

Snapshot snapshotOf(LungModel model, const QString& name) {
  Snapshot snapshot{std::move(model), nullptr, name};
  if (const auto tree = treeOf(snapshot.model)) {
    snapshot.figures = std::make_shared<const TreeFigures>(treeFigures(*tree));
  }
  return snapshot;
}

double lungVolumeMl(const LungModel& model) {
  double sum = 0.0;
  if (model.surfaces) {
    for (const auto& surface : *model.surfaces) sum += surface.health.volumeMl;
  }
  return sum;
}

std::vector<QString> warningsOf(const Snapshot& snapshot) {
  std::vector<QString> warnings;
  for (const auto& sentence : snapshot.model.warnings) warnings.push_back(qtText(sentence));
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
