#include "pipeline/lung_corrections.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "core/error.h"
#include "pipeline/lobes_model.h"
#include "pipeline/segment_report.h"

namespace pneuma {
namespace {

/// What was corrected before, or what is corrected for the first time.
LungCorrections begun(const LungModel& model) {
  if (model.corrections) return *model.corrections;
  LungCorrections corrections;
  if (model.lungs && model.labels.get() == &model.lungs->labels) {
    corrections.found = model.lungs;
  } else {
    corrections.read = model.labels;
  }
  return corrections;
}

/// Without what followed from the labels before, but with the surfaces of whole lungs.
LungModel withOtherLabels(const LungModel& model, std::shared_ptr<const LabelImage> labels,
                          LungCorrections corrections) {
  LungModel result;
  result.ct = model.ct;
  result.ctSource = model.ctSource;
  result.inputs = model.inputs;
  result.warnings = model.warnings;
  result.readSeconds = model.readSeconds;
  result.lungs = model.lungs;
  result.labels = std::move(labels);
  result.corrections = std::make_shared<const LungCorrections>(std::move(corrections));
  result.surfaces = wholeLungsOf(model);
  result.central = model.central;
  result.opened = model.opened;
  result.cubes = model.cubes;
  return result;
}

}  // namespace

std::string correctionObstacle(const LungModel& model) {
  if (!model.ct) return "there is no CT to correct lungs in; open one first";
  if (!model.labels) return "there are no lungs to correct; find them first";
  if (!sameVoxels(model.ct->geometry, model.labels->geometry)) {
    return "the labels of the lungs have other voxels than the CT; find the lungs in it first";
  }
  return {};
}

LungModel withEdits(const LungModel& model, std::vector<LungEdit> edits,
                    std::shared_ptr<const LabelImage> labels) {
  LungCorrections corrections = begun(model);
  std::move(edits.begin(), edits.end(), std::back_inserter(corrections.edits));
  return withOtherLabels(model, std::move(labels), std::move(corrections));
}

std::shared_ptr<const LabelImage> correctedLabels(const LungModel& model,
                                                  const Progress& progress) {
  const LungCorrections& corrections = *model.corrections;
  return std::make_shared<const LabelImage>(
      editedLabels(*model.ct, corrections.before(), corrections.edits, progress));
}

LungModel measuredAgain(const LungModel& model, double thresholdHu, const Progress& progress) {
  LungModel result = model;
  if (!model.lungs || !model.corrections || !model.corrections->found) return result;
  const auto measured = std::make_shared<const LungSegmentation>(
      measuredAgain(*model.ct, *model.labels, *model.corrections->found, thresholdHu, progress));
  for (const SegmentationCheck& check : model.lungs->checks) {
    if (!check.ok()) std::erase(result.warnings, sentence(check));
  }
  for (const SegmentationCheck& check : measured->checks) {
    if (!check.ok()) result.warnings.push_back(sentence(check));
  }
  result.lungs = measured;
  return result;
}

LungModel withLungEdits(const LungModel& model, std::span<const LungEdit> edits, double thresholdHu,
                        const Progress& progress) {
  if (edits.empty()) return model;
  const std::string obstacle = correctionObstacle(model);
  if (!obstacle.empty()) throw InvalidInput(obstacle);
  LungCorrections corrections = begun(model);
  corrections.edits.insert(corrections.edits.end(), edits.begin(), edits.end());
  auto labels = std::make_shared<const LabelImage>(editedLabels(
      *model.ct, *model.labels, edits, progress.part(0.0, 0.3, "correcting the lungs")));
  LungModel result = withOtherLabels(model, std::move(labels), std::move(corrections));
  result.surfaces = nullptr;
  return measuredAgain(result, thresholdHu, progress.part(0.3, 1.0, "measuring the lungs"));
}

}  // namespace pneuma
