#pragma once

#include <map>

#include "anatomy/lobe.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// The whole lungs of the sample chest as closed surfaces, about 4,000 points each: what the
/// experiments of papers on breathing are repeated on.
std::map<Side, TriangleMesh> sampleWalls(const Progress& progress = {});

}  // namespace pneuma
