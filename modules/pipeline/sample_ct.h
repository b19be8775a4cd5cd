#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "core/image.h"
#include "core/options.h"
#include "core/progress.h"
#include "pipeline/sample_chest.h"

namespace pneuma {

/// Options of the CT of the sample chest. What makes it hard for a segmentation is off by default.
struct SampleCtOptions {
  double spacingMm = 0.8;
  double thickMm = 2.5;
  double noiseHu = 20.0;
  double tiltDeg = 0.0;
  int gaps = 0;
  double touchingLungsMm = 0.0;
  bool collapsed = false;
  bool stomachGas = false;
  bool mirror = false;
  std::uint64_t seed = 1;

  static constexpr auto fields() {
    using O = SampleCtOptions;
    return std::tuple{
        Field{"spacing", &O::spacingMm, "mm", Range{0.4, 5.0}, "Distance of voxels in a slice."},
        Field{"thick", &O::thickMm, "mm", Range{0.4, 10.0},
              "Distance and thickness of the slices; a voxel is the mean over its thickness."},
        Field{"noise", &O::noiseHu, "HU", Range{0.0, 300.0}, "Standard deviation of the noise."},
        Field{"tilt", &O::tiltDeg, "deg", Range{-30.0, 30.0},
              "Tilt of the gantry: slices lean, one is not straight above the other."},
        Field{"gaps", &O::gaps, "", Range{0, 20},
              "So many slices inside are missing in the DICOM series; the volume file has them."},
        Field{"touching-lungs", &O::touchingLungsMm, "mm", Range{0.0, 20.0},
              "So deep from front to back only a sheet of 0.3 mm parts the lungs in front of the "
              "aorta, up to 7 mm of it behind the oesophagus too."},
        Field{"collapsed", &O::collapsed, "", Range{0, 1},
              "The lower part of the left lung holds no air."},
        Field{"stomach-gas", &O::stomachGas, "", Range{0, 1},
              "The stomach's gas lies 1 mm below the left lung."},
        Field{"mirror", &O::mirror, "", Range{0, 1},
              "Left and right are swapped, as if the header were wrong."},
        Field{"seed", &O::seed, "", Range{0, 9007199254740991.0},
              "Seed of everything random: same seed, same bytes."},
    };
  }

  bool operator==(const SampleCtOptions&) const = default;
};

/// The sample chest as a CT, and what is known about it.
struct SampleCt {
  CtImage image;
  /// 10 and 20 inside the pleura with vessels and the airways' walls, 6 the lumen of trachea and
  /// bronchi; by the voxels' centres. With `mirror` they follow the header, as a segmentation does:
  /// 10 is the lung on the header's right, which is the patient's left one.
  LabelImage truth;
  AirwayTree
      central;  ///< of the sample chest: trachea, main and lobar bronchi; at the image's side
  AirwayTree airways;        ///< all that were drawn; the central ones come first
  std::vector<int> missing;  ///< slices that the DICOM series shall leave out, upwards
};

/// Scans the chest. Voxels are means over their volume, blurred by 0.6 mm within the slice; the
/// same for any number of threads. Axes: i to the left, j to the back, k up; with a tilt j leans.
/// @throws InvalidOption naming the field; Cancelled
SampleCt sampleCt(const SampleChest& chest, const SampleCtOptions& options,
                  const Progress& progress = {});

/// The same of sampleChest().
SampleCt sampleCt(const SampleCtOptions& options, const Progress& progress = {});

/// The chest seen in a mirror, left for right: surfaces, fissures and airways. Names and `truth`
/// stay those of the chest.
SampleChest mirrored(SampleChest chest);

/// Voxels with the label, ml.
double labelMl(const LabelImage& labels, Lobe label);

}  // namespace pneuma
