#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/image.h"
#include "core/options.h"
#include "core/progress.h"
#include "segmentation/airway_finding.h"
#include "segmentation/bronchus_names.h"
#include "segmentation/handedness.h"

namespace pneuma {

/// How far dense or collapsed parts at the edge of a lung are taken in.
enum class DenseRepair { Off, Soft, Strong };

constexpr auto choices(DenseRepair) {
  return std::array<std::string_view, 3>{"off", "soft", "strong"};
}

/// Whether gas of stomach and bowel that hangs together with a lung is taken out of it.
enum class GasPockets { Remove, Keep };

constexpr auto choices(GasPockets) { return std::array<std::string_view, 2>{"remove", "keep"}; }

struct LungOptions {
  double thresholdHu = -500.0;  ///< air is less dense
  double closingMm = 10.0;      ///< ball that closes vessels and the hilum
  DenseRepair repair = DenseRepair::Off;
  GasPockets gas = GasPockets::Remove;
  double wallContrastHu = 160.0;  ///< of bronchi

  static constexpr auto fields() {
    return std::tuple{
        Field{"threshold", &LungOptions::thresholdHu, "HU", Range{-900.0, -200.0},
              "Radiodensity under which a voxel is air."},
        Field{"closing", &LungOptions::closingMm, "mm", Range{0.0, 40.0},
              "Radius of the ball that takes vessels and the hilum into the lungs."},
        Field{"repair", &LungOptions::repair, "", Range{},
              "Takes dense or collapsed parts at the edge of a lung in: balls of 20 or 30 mm."},
        Field{"gas", &LungOptions::gas, "", Range{},
              "What to do with gas of stomach or bowel that hangs together with a lung."},
        Field{"wall-contrast", &LungOptions::wallContrastHu, "HU", Range{20.0, 600.0},
              "Difference to its surroundings that a bronchus must show to be followed."},
    };
  }

  bool operator==(const LungOptions&) const = default;
};

/// One lung as it was found.
struct LungFinding {
  double volumeMl = 0.0;  ///< without the airways that have a label of their own
  double volumeWithAirwaysMl = 0.0;
  double airMl = 0.0;            ///< what was under the threshold, before closing
  double meanHu = 0.0;           ///< vessels included
  double denseShare = 0.0;       ///< what closing by a ball of 30 mm would add, as a share
  double droppedMl = 0.0;        ///< pieces that do not hang together with it, left out
  double borderMm2 = 0.0;        ///< of its surface at the border of what the scanner saw
  double lowestSliceMm2 = 0.0;   ///< its section in the lowest slice
  double highestSliceMm2 = 0.0;  ///< its section in the highest slice
};

/// A figure with the limits it should keep.
struct SegmentationCheck {
  std::string id;    ///< "LUNG-R-VOLUME" ...
  std::string what;  ///< for people
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::string unit;
  std::string advice;  ///< what to do if it fails

  bool ok() const { return value >= low && value <= high; }
};

/// Lungs and central airways of a CT.
struct LungSegmentation {
  LabelImage labels;  ///< 10 right lung, 20 left lung, 6 trachea and bronchi; as the CT lies
  LungFinding right;
  LungFinding left;
  AirwayFinding airways;
  AirwayTree central;     ///< root at the top of the trachea; empty if none was found
  BronchusNames names;    ///< of its branches
  bool separated = true;  ///< false if nothing told the lungs apart but the middle
  double bridgeMm = 0.0;  ///< radius of the bridge between the lungs that was cut
  double gasRemovedMl = 0.0;
  double airElsewhereMl = 0.0;  ///< in spaces beside the upper two thirds of the lungs, in no label
  Handedness hands;             ///< whether left and right look swapped
  std::vector<SegmentationCheck> checks;
};

/// Finds lungs and central airways (docs/algorithms/lungs.md).
/// @param ct in HU, axes in any order
/// @throws InvalidOption; InvalidInput if there is no air like that of lungs; Cancelled
LungSegmentation segmentLungs(const CtImage& ct, const LungOptions& options = {},
                              const Progress& progress = {});

/// What was found, with the figures and checks of lungs that have other labels now, as after
/// corrections by hand. The result holds no labels.
/// @param labels with the voxels of the CT
/// @param thresholdHu of air, as the lungs were found with
/// @throws Cancelled
LungSegmentation measuredAgain(const CtImage& ct, const LabelImage& labels,
                               const LungSegmentation& found, double thresholdHu,
                               const Progress& progress = {});

}  // namespace pneuma
