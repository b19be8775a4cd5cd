#include "segmentation/segmentation_checks.h"

#include <limits>

namespace pneuma {
namespace {

void checkLung(const LungFinding& lung, const std::string& id, const std::string& name,
               std::vector<SegmentationCheck>& checks) {
  checks.push_back({id + "-VOLUME", "volume of the " + name + " lung", lung.volumeWithAirwaysMl,
                    600.0, 5000.0, "ml",
                    "it may be collapsed, removed or cut off; try --repair strong"});
  checks.push_back({id + "-DENSITY", "mean density of the " + name + " lung", lung.meanHu, -950.0,
                    -500.0, "HU", "check that the values are Hounsfield units"});
  checks.push_back({id + "-BORDER", "surface of the " + name + " lung at the border of the slices",
                    lung.borderMm2 / 100.0, 0.0, 2.0, "cm2",
                    "the field of view cuts the lung off; its volume is too small"});
  checks.push_back({id + "-LOWEST", "section of the " + name + " lung in the lowest slice",
                    lung.lowestSliceMm2 / 100.0, 0.0, 5.0, "cm2",
                    "the scan ends above the lung's base; its volume is too small"});
  checks.push_back({id + "-HIGHEST", "section of the " + name + " lung in the highest slice",
                    lung.highestSliceMm2 / 100.0, 0.0, 5.0, "cm2",
                    "the scan begins below the lung's apex; its volume is too small"});
  checks.push_back({id + "-DROPPED", "pieces beside the " + name + " lung", lung.droppedMl, 0.0,
                    20.0, "ml", "they do not hang together with it and were left out"});
  checks.push_back({id + "-DENSE", "dense parts at the edge of the " + name + " lung",
                    100.0 * lung.denseShare, 0.0, 5.0, "%",
                    "dense or collapsed parts may be missing; try --repair strong"});
}

}  // namespace

std::vector<SegmentationCheck> segmentationChecks(const LungSegmentation& found) {
  std::vector<SegmentationCheck> checks;
  checkLung(found.right, "LUNG-R", "right", checks);
  checkLung(found.left, "LUNG-L", "left", checks);
  const double left = found.left.volumeWithAirwaysMl;
  const double ratio =
      left > 0.0 ? found.right.volumeWithAirwaysMl / left : std::numeric_limits<double>::infinity();
  checks.push_back({"LUNG-RATIO", "right lung to left", ratio, 0.8, 1.6, "",
                    "one lung may be collapsed or have lost a part"});
  checks.push_back({"LUNG-PARTED", "air beside the lungs that belongs to neither",
                    found.airElsewhereMl, 0.0, 20.0, "ml",
                    "a part of a lung may hang together with neither; look at the slices"});
  checks.push_back({"LUNG-SEPARATED", "the lungs were told apart where they touch",
                    found.separated ? 1.0 : 0.0, 1.0, 1.0, "",
                    "the lungs touch and nothing tells them apart; they were cut at the body's "
                    "middle: look at the border between them"});
  checks.push_back({"HANDEDNESS", "left and right as in most people",
                    static_cast<double>(found.hands.votes()), -1.0, 3.0, "votes",
                    "left and right may be swapped: the heart, the larger lung and the higher dome "
                    "of the diaphragm lie on the other side; check the header's orientation, "
                    "nothing was changed"});
  checks.push_back({"AIRWAY-TRACHEA", "length of the trachea", found.airways.tracheaLengthMm, 20.0,
                    300.0, "mm", "no airways were found; growth will use template airways"});
  if (!found.airways.found) return checks;
  checks.push_back({"AIRWAY-VOLUME", "volume of the airways", found.airways.volumeMl, 3.0, 120.0,
                    "ml", "the airways may have leaked into a lung; look at them in the slices"});
  checks.push_back({"AIRWAY-LEAK", "largest step of the airways", found.airways.largestStepMl, 0.0,
                    5.0, "ml", "the airways may have leaked; raise --wall-contrast"});
  checks.push_back({"AIRWAY-FOLLOWED", "steps along bronchi beyond the main ones",
                    static_cast<double>(found.airways.stepsFollowed), 1.0, 1e9, "",
                    "no bronchus was followed beyond those that are wide; the slices may be too "
                    "thick, or lower --wall-contrast"});
  return checks;
}

}  // namespace pneuma
