#include "segmentation/lung_segmentation.h"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "core/error.h"
#include "segmentation/airway_centreline.h"
#include "segmentation/airway_segmentation.h"
#include "segmentation/gas_pockets.h"
#include "segmentation/inner_air.h"
#include "segmentation/lung_air.h"
#include "segmentation/lung_closing.h"
#include "segmentation/lung_labels.h"
#include "segmentation/segmentation_checks.h"

namespace pneuma {
namespace {

LungSegmentation segmentUpright(const CtImage& ct, const LungOptions& options,
                                const Progress& progress) {
  LungSegmentation result;
  LabelImage& labels = result.labels;
  labels.geometry = ct.geometry;
  labels.voxels.assign(ct.voxels.size(), 0);
  progress.part(0.0, 0.1, "finding air").report(0.0);
  AirwayMask airways;
  double middle = 0.0;
  {
    const InnerAir air = findInnerAir(ct, options.thresholdHu);
    airways = segmentAirways(ct, air, {.wallContrastHu = options.wallContrastHu}, labels.voxels,
                             progress.part(0.1, 0.3, "following airways"));
    const LungAir lungs =
        findLungAir(ct, air, airways, labels, progress.part(0.3, 0.5, "telling the lungs apart"));
    middle = lungs.middle;
    result.separated = lungs.separated;
    result.bridgeMm = lungs.bridgeMm;
    result.airElsewhereMl = lungs.elsewhereMl;
  }
  if (options.gas == GasPockets::Remove) {
    result.gasRemovedMl =
        removeGasPockets(ct, labels, progress.part(0.5, 0.55, "looking for gas of the stomach"));
  }
  for (const std::uint32_t v : airways.voxels) labels.voxels[v] = AirwayLabel;
  result.airways = airways.finding;
  result.central =
      airwayCentreline(ct.geometry, airways, progress.part(0.55, 0.6, "drawing the centreline"));
  result.names = nameBronchi(result.central);
  airways = {};
  result.right = closeLung(ct, RightLabel, options, labels, progress.part(0.6, 0.8, "closing"));
  result.left = closeLung(ct, LeftLabel, options, labels, progress.part(0.8, 1.0, "closing"));
  result.hands = handednessOf(labels, middle);
  return result;
}

}  // namespace

LungSegmentation segmentLungs(const CtImage& ct, const LungOptions& options,
                              const Progress& progress) {
  requireValid(options);
  if (ct.voxels.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Unsupported("a CT of " + std::to_string(ct.voxels.size()) +
                      " voxels is too large for finding lungs; crop or resample it below 4.29e9");
  }
  const AxisOrder order = patientAxes(ct.geometry);
  LungSegmentation result = order.isIdentity()
                                ? segmentUpright(ct, options, progress)
                                : segmentUpright(turned(ct, order), options, progress);
  if (!order.isIdentity()) result.labels = turned(result.labels, inverse(order));
  result.checks = segmentationChecks(result);
  return result;
}

LungSegmentation measuredAgain(const CtImage& ct, const LabelImage& labels,
                               const LungSegmentation& found, double thresholdHu,
                               const Progress& progress) {
  const AxisOrder order = patientAxes(ct.geometry);
  if (!order.isIdentity()) {
    return measuredAgain(turned(ct, order), turned(labels, order), found, thresholdHu, progress);
  }
  LungSegmentation result;
  result.right = found.right;
  result.left = found.left;
  result.airways = found.airways;
  result.central = found.central;
  result.names = found.names;
  result.separated = found.separated;
  result.bridgeMm = found.bridgeMm;
  result.gasRemovedMl = found.gasRemovedMl;
  result.airElsewhereMl = found.airElsewhereMl;
  result.hands = found.hands;
  measureLung(ct, RightLabel, thresholdHu, labels, result.right,
              progress.part(0.0, 0.5, "measuring"));
  measureLung(ct, LeftLabel, thresholdHu, labels, result.left,
              progress.part(0.5, 1.0, "measuring"));
  result.checks = segmentationChecks(result);
  return result;
}

}  // namespace pneuma
