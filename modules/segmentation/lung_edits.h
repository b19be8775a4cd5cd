#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/lobe.h"
#include "core/image.h"
#include "core/progress.h"

namespace pneuma {

/// What a person does to lungs that were found.
enum class LungTool { Paint, Erase, Seed };

constexpr auto choices(LungTool) {
  return std::array<std::string_view, 3>{"paint", "erase", "seed"};
}

/// What a brush covers around its stroke: a ball, or a disc in one slice.
enum class BrushShape { Ball, AxialDisc, CoronalDisc, SagittalDisc };

constexpr auto choices(BrushShape) {
  return std::array<std::string_view, 4>{"ball", "axial disc", "coronal disc", "sagittal disc"};
}

inline constexpr double LeastBrushMm = 0.5;
inline constexpr double MostBrushMm = 100.0;

/// What a seed takes in where it does not say, HU.
inline constexpr double SeedBelowHu = -500.0;

/// No seed takes in more, ml.
inline constexpr double MostSeedMl = 3000.0;

/// One correction of lungs by hand. Voxels of trachea and bronchi are never changed.
struct LungEdit {
  LungTool tool = LungTool::Paint;
  Side side = Side::None;  ///< the lung; None, for erasing alone: either
  BrushShape shape = BrushShape::Ball;
  double radiusMm = 5.0;          ///< of the brush
  std::vector<Vec3> points;       ///< of a stroke, from one to the next, LPS, mm; of a seed one
  std::optional<double> belowHu;  ///< only voxels that are less dense; none: all, of a seed those
                                  ///< under SeedBelowHu

  bool operator==(const LungEdit&) const = default;
};

/// What is wrong with an edit of an image, as the rest of a sentence ("has no points"); empty if
/// nothing is.
std::string problemOf(const LungEdit& edit, const ImageGeometry& geometry);

/// True if voxel (i, j, k) of both lies at the same place, to a hundredth of a voxel.
bool sameVoxels(const ImageGeometry& a, const ImageGeometry& b);

/// Paints, erases, or grows from a seed. A stroke covers what is no farther from it than its
/// radius; it takes voxels from the other lung, too. Only the box around the stroke is looked at.
///
/// A seed takes in what hangs together with it by faces of voxels, is less dense than its limit and
/// has no label. It takes nothing, and says why, where that would reach the border of the slices or
/// an airway through air, is as empty as air outside of lungs, or is larger than MostSeedMl.
///
/// @param labels with the voxels of the CT (sameVoxels())
/// @return how many voxels have another label now
/// @pre problemOf() is empty @throws InvalidInput (a seed that cannot be; labels are as before)
std::size_t applyEdit(const CtImage& ct, const LungEdit& edit, LabelImage& labels,
                      const Progress& progress = {});

/// All edits, one after the other, on a copy.
/// @throws InvalidInput, naming the edit by its number if there are several; Cancelled
LabelImage editedLabels(const CtImage& ct, const LabelImage& labels,
                        std::span<const LungEdit> edits, const Progress& progress = {});

/// The lung at a point, or the one nearest to it up to 60 mm away; None if there is none.
Side nearestLung(const LabelImage& labels, const Vec3& point);

}  // namespace pneuma
