#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// A region's number in a complex; 0 is outside of all.
using RegionId = std::uint8_t;

inline constexpr RegionId OutsideRegion = 0;

/// A triangle between two regions: its corners turn counter-clockwise seen from `front`.
struct Facet {
  std::array<std::uint32_t, 3> corners{};
  RegionId behind = OutsideRegion;
  RegionId front = OutsideRegion;

  bool borders(RegionId region) const { return behind == region || front == region; }
};

/// Regions of space and the triangles between them. A triangle that two regions share is there
/// once, so that neighbours cannot differ.
struct RegionComplex {
  std::vector<Vec3> points;  ///< LPS, mm
  std::vector<Facet> facets;
};

/// One region: what a closed mesh encloses.
RegionComplex complexOf(const TriangleMesh& mesh, RegionId region);

/// A region's closed surface, oriented outwards, with the points it uses.
struct RegionSurface {
  TriangleMesh mesh;
  std::vector<std::uint32_t> facetOf;  ///< of each triangle, in the complex
};

RegionSurface surfaceOf(const RegionComplex& complex, RegionId region);

/// The triangles between a region and some others, normals from `behind` to `fronts`.
TriangleMesh contactOf(const RegionComplex& complex, RegionId behind,
                       std::span<const RegionId> fronts);

inline TriangleMesh contactOf(const RegionComplex& complex, RegionId behind, RegionId front) {
  return contactOf(complex, behind, std::span<const RegionId>(&front, 1));
}

/// Volume of a region, mm^3, summed with compensation from its first point.
double volumeMm3(const RegionComplex& complex, RegionId region);

}  // namespace pneuma
