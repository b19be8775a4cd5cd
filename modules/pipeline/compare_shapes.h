#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"
#include "io/json.h"
#include "pipeline/lung_model.h"
#include "segmentation/distance_summary.h"
#include "segmentation/label_agreement.h"

namespace pneuma {

/// What two label images or two surfaces must keep to count as the same; what is not set is not
/// asked for.
struct ShapeLimits {
  double minDice = 0.0;
  double maxHd95Mm = 0.0;
  double maxDistanceMm = 0.0;
  double maxVolumePercent = 0.0;

  static constexpr auto fields() {
    using L = ShapeLimits;
    return std::tuple{
        Field{"min-dice", &L::minDice, "", Range{0.0, 1.0},
              "Least overlap of each label of two label images; 0: any."},
        Field{"max-hd95", &L::maxHd95Mm, "mm", Range{0.0, 1e4},
              "Largest 95th percentile of the distances of the boundaries; 0: any."},
        Field{"max-distance", &L::maxDistanceMm, "mm", Range{0.0, 1e4},
              "Largest distance of two surfaces; 0: any."},
        Field{"max-volume", &L::maxVolumePercent, "%", Range{0.0, 1e4},
              "Largest difference of volume of a label or surface; 0: any."},
    };
  }

  bool operator==(const ShapeLimits&) const = default;
};

/// How far two surfaces lie apart, measured from the points of each to the other.
struct SurfaceDistance {
  double firstMl = 0.0;
  double secondMl = 0.0;
  DistanceSummary between;
};

/// @pre both have triangles
SurfaceDistance surfaceDistance(const TriangleMesh& first, const TriangleMesh& second,
                                const Progress& progress = {});

/// What comparing two shapes gave, beside the limits.
struct ShapeComparison {
  std::array<std::filesystem::path, 2> paths;
  std::vector<LabelAgreement> labels;     ///< of two label images; the last one is all together
  std::vector<SurfaceDistance> surfaces;  ///< one, of two surfaces
  ShapeLimits limits;
  std::vector<std::string> failures;  ///< sentences: what is over its limit
};

/// True if both are volume files, or both surfaces: what compareShapes() takes.
bool areShapes(const std::filesystem::path& first, const std::filesystem::path& second);

/// Compares two label images label by label, or two surfaces.
/// @throws InputMissing, InvalidInput (damaged; not the same voxels), Unsupported
ShapeComparison compareShapes(const std::filesystem::path& first,
                              const std::filesystem::path& second, const ShapeLimits& limits,
                              const Progress& progress = {});

/// The report of comparing shapes ("pneuma/compare-shapes/1"), and the same for people.
Json toJson(const ShapeComparison& comparison, std::span<const InputFile> inputs);
std::string textOf(const ShapeComparison& comparison);

}  // namespace pneuma
