#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/fissure_snapping.h"
#include "pipeline/lung_shape.h"
#include "pipeline/split_lobes.h"

namespace pneuma {

/// A fissure inside its lung, and how much of it shows in the CT.
struct TracedFissure {
  UsedFissure used;
  std::vector<Vec3> points;  ///< that were given, where they lie now
  std::shared_ptr<const TriangleMesh> patch;
  std::optional<Completeness> complete;  ///< of the patch; none without sheets
};

using TracedFissures = std::map<Fissure, TracedFissure>;

/// The fissures of one lung as splitLobes() would cut along them, in a second and with nothing cut.
/// @param inputs those of other lungs, and wanted shares, do not matter
/// @param sheets of this lung; null: nothing is snapped and no completeness told
/// @throws as fissureSurfaces() and snapFissures()
TracedFissures tracedFissures(const std::shared_ptr<const LungShape>& lung,
                              const LobeInputs& inputs, const LobeOptions& options,
                              const SheetnessImage* sheets, const Progress& progress = {});

/// The same of lobes that were split. @param given their fissures' points
TracedFissures tracedFissures(const LobesOfLungs& lobes, const GivenFissures& given);

/// Where a fissure shows, by the triangles of its patch, for places near it.
class ShownParts {
 public:
  /// @param onSheet of every triangle of the patch
  ShownParts(const HeightSurface& surface, const TriangleMesh& patch,
             const std::vector<std::uint8_t>& onSheet);

  /// True where a sheet was found, and where the patch does not tell.
  bool shows(const Vec3& p) const;

 private:
  std::size_t cellOf(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  HeightSurface frame_;  ///< its plane alone
  Vec2 first_ = Vec2::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> missing_;  ///< of the cells
};

}  // namespace pneuma
