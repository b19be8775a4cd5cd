#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "anatomy/lobe.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// The lobes, or whole lungs, of a surface whose triangles say which they are of, as those of a
/// breath's frame do.
/// @param lobes the value of a Lobe for every triangle of `mesh`
/// @returns nothing if there are none, or one of them is no lobe or lung
std::map<Lobe, TriangleMesh> lobeParts(const TriangleMesh& mesh,
                                       std::span<const std::uint8_t> lobes);

}  // namespace pneuma
