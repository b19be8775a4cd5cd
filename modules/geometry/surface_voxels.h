#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// One byte for each voxel of an image of this geometry: 1 where its centre lies inside a closed
/// surface, by the parity of crossings along the rows. Where surfaces share triangles with
/// bit-equal corners, each voxel lies in one of them exactly.
/// @param surface closed, LPS, mm; parts beyond the image are left out
/// @throws Cancelled
std::vector<std::uint8_t> voxelsInside(const TriangleMesh& surface, const ImageGeometry& geometry,
                                       const Progress& progress = {});

/// The smallest image with axes along LPS and cubic voxels that holds a box with a margin.
/// @throws InvalidInput if it would have more than `mostVoxels`
ImageGeometry geometryAround(const Box3& box, double spacingMm, int marginVoxels,
                             std::size_t mostVoxels = std::size_t{1} << 30);

}  // namespace pneuma
