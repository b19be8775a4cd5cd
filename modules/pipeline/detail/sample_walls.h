#pragma once

#include <map>

#include "anatomy/lobe.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// The whole lungs of the sample chest as closed surfaces: what the
/// experiments of papers on breathing are repeated on.
std::map<Side, TriangleMesh> sampleWalls();

}  // namespace pneuma
