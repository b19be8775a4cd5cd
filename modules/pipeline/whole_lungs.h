#pragma once

#include <filesystem>
#include <span>
#include <tuple>

#include "core/options.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// Which labels of an image are lungs, where it follows other numbers than ours.
struct LungLabelOptions {
  int right = 0;
  int left = 0;

  static constexpr auto fields() {
    using O = LungLabelOptions;
    return std::tuple{
        Field{"right-label", &O::right, "", Range{0, 255},
              "The right lung's number in a label image; 0: 10, or the lobes 1 to 3."},
        Field{"left-label", &O::left, "", Range{0, 255},
              "The left lung's number in a label image; 0: 20, or the lobes 4 and 5."},
    };
  }

  bool operator==(const LungLabelOptions&) const = default;
};

/// Whole lungs to split, from whatever there is: a CT (its lungs are found), an image of labels,
/// surfaces of whole lungs, or surfaces of lobes, which are joined by withWholeLungs(). They are
/// untangled().
/// @throws InvalidInput, InputMissing, Unsupported as the readers; Cancelled
LungModel openLungs(std::span<const std::filesystem::path> paths,
                    const LungLabelOptions& labels = {}, const Progress& progress = {});

/// The same with lobes joined to whole lungs. Lobes that share their triangles are welded: nothing
/// moves, and the volume is the sum of theirs. Where they do not share them, or where the weld is
/// not sound, the lung is drawn anew from voxels: gaps of up to 6 mm between lobes are
/// closed, and the lobes' volume is kept; a warning says so.
/// @throws InvalidInput if a lobe of a lung is missing, or is open
LungModel withWholeLungs(const LungModel& model, const Progress& progress = {},
                         double voxelMm = 1.0);

/// The same without triangles that cut each other: the few folds that surfaces drawn from voxels
/// have are smoothed away, see untangle(); a warning says so.
/// @throws InvalidInput if that does not help; Cancelled
LungModel untangled(const LungModel& model, const Progress& progress = {});

/// @throws InvalidInput if the right lung lies to the left of the left one
void requireSides(const LungModel& model);

}  // namespace pneuma
