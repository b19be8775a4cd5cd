#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/domain.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// Edges with one triangle, from and to as that triangle turns.
std::vector<std::array<std::uint32_t, 2>> rimOf(const TriangleMesh& sheet);

/// The place of a sheet's rim that lies deepest in a region.
struct RimPlace {
  Vec3 place = Vec3::Zero();
  double depthMm = 0.0;  ///< from the region's wall; 0 if the rim is outside
};

/// How far a point lies above where a region ends below, mm; negative below.
using HeightAboveFloor = std::function<double(const Vec3&)>;

/// How far the sheet is from reaching the wall of a region all around.
/// @param floor where the region ends below, besides; may be empty
RimPlace deepestRim(const TriangleMesh& sheet, const Domain& region,
                    const HeightAboveFloor& floor = {});

/// A fissure's surface from a file may miss the wall by this much.
inline constexpr double RimToleranceMm = 1.0;

/// @param what names the sheet in sentences ("surface of the left oblique fissure")
/// @param where what it has to part ("lung")
/// @throws InvalidInput if the rim is deeper in the region than the tolerance and `extendMm`
void requireReach(const RimPlace& rim, double extendMm, const std::string& what,
                  const std::string& where);

/// The sheet with a strip along its rim wherever that ends in a region or near its wall, so broad
/// that it leaves the region, in the sheet's own direction there.
/// @pre the sheet is manifold and oriented
TriangleMesh extendedThrough(const TriangleMesh& sheet, const Domain& region);

}  // namespace pneuma
