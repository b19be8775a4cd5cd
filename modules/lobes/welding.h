#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "lobes/region_complex.h"

namespace pneuma {

/// Surfaces of neighbours as one complex.
struct Welding {
  RegionComplex complex;
  std::size_t sharedTriangles = 0;  ///< that two surfaces have, turned to each other
  std::size_t conflicts = 0;        ///< that two surfaces have, turned the same way: they overlap
};

/// Joins points with bit-equal coordinates, and triangles that two surfaces have into one facet
/// between both regions.
/// @param surfaces with a region's number each, closed, oriented outwards
Welding weld(std::span<const std::pair<RegionId, const TriangleMesh*>> surfaces);

/// What encloses all regions of a complex together, oriented outwards.
TriangleMesh outerSurface(const RegionComplex& complex);

}  // namespace pneuma
